// What the hub is told of a station together with its state.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace traygauge {

// Of the lens; of two, the worse one.
struct CalibrationFacts {
  double grade_percent = 0.0;  // two standard deviations of a volume, as far as the lens goes
  std::string calibrated_on;   // YYYY-MM-DD; empty: not known
};

struct StationFacts {
  std::vector<std::string> dish_styles;  // what the next tray may be said to carry
  std::string configuration_problem;     // empty: the configuration is the one that somebody wrote
  std::vector<std::string> devices;      // as faults name them
  std::optional<CalibrationFacts> calibration;
};

}  // namespace traygauge
