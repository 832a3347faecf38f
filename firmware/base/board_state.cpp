#include "firmware/base/board_state.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <string>
#include <system_error>
#include <vector>

namespace traygauge {
namespace {

namespace fs = std::filesystem;

constexpr double kMillidegrees = 1000.0;
constexpr double kHottestC = 200.0;  // what a broken sensor says is beyond

std::vector<fs::path> entries_of(const fs::path& folder) {
  std::vector<fs::path> entries;
  std::error_code error;
  fs::directory_iterator entry(folder, error);
  while (!error && entry != fs::directory_iterator()) {
    entries.push_back(entry->path());
    entry.increment(error);
  }
  return entries;
}

std::string line_in(const fs::path& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  return line;
}

std::optional<double> hottest_c(const fs::path& zones) {
  std::optional<double> hottest;
  for (const fs::path& zone : entries_of(zones)) {
    const std::string text = line_in(zone / "temp");
    char* end = nullptr;
    const double celsius = std::strtod(text.c_str(), &end) / kMillidegrees;
    if (end == text.c_str() || !(std::abs(celsius) < kHottestC)) continue;
    hottest = std::max(hottest.value_or(celsius), celsius);
  }
  return hottest;
}

// Raspberry Pis have a sensor of that name; the alarm stays on once it was raised.
std::optional<bool> was_under_voltage(const fs::path& sensors) {
  for (const fs::path& sensor : entries_of(sensors)) {
    if (line_in(sensor / "name") != "rpi_volt") continue;
    const std::string alarm = line_in(sensor / "in0_lcrit_alarm");
    if (alarm == "0" || alarm == "1") return alarm == "1";
  }
  return std::nullopt;
}

}  // namespace

BoardState read_board_state(const fs::path& classes) {
  return {hottest_c(classes / "thermal"), was_under_voltage(classes / "hwmon")};
}

}  // namespace traygauge
