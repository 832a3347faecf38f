// What the hub is told of a station together with its state.
#pragma once

#include <string>
#include <vector>

namespace traygauge {

struct StationFacts {
  std::vector<std::string> dish_styles;  // what the next tray may be said to carry
  std::string configuration_problem;     // empty: the configuration is the one that somebody wrote
};

}  // namespace traygauge
