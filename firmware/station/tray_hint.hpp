// What somebody who knows, such as a till, says of a tray before it is measured.
#pragma once

#include <string>
#include <vector>

namespace traygauge {

struct TrayHint {
  std::string tray;                 // what the tray is called where the result is stored; empty: nothing
  int foods = 0;                    // how many lie on it; 0: as many as are found
  std::vector<std::string> dishes;  // their styles, all that stand on it; empty: as configured

  friend bool operator==(const TrayHint&, const TrayHint&) = default;
};

}  // namespace traygauge
