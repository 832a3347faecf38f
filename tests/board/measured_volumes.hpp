// The volumes that a document of the program tells, and those that `traygauge measure` finds.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/board/child_program.hpp"
#include "tests/board/station_rig.hpp"

namespace traygauge {

// Label to millilitres.
using Volumes = std::map<int, double>;

inline Volumes volumes_ml(const nlohmann::json& document) {
  Volumes volumes;
  for (const nlohmann::json& item : document["items"]) {
    if (!item["volume_ml"].is_null()) volumes[item["label"]] = item["volume_ml"];
  }
  return volumes;
}

// The largest difference of those found; 1e9 where one of them is not expected.
inline double worst_difference_ml(const Volumes& found, const Volumes& expected) {
  double worst_ml = 0.0;
  for (const auto& [label, volume_ml] : found) {
    const auto known = expected.find(label);
    worst_ml = std::max(worst_ml, known == expected.end() ? 1e9 : std::abs(known->second - volume_ml));
  }
  return worst_ml;
}

inline Volumes measure_ml(const std::string& program, const std::string& capture, Outlines outlines) {
  const char* const labels = outlines == Outlines::given ? "given" : "auto";
  ChildProgram run(program + " measure " + capture + " --labels " + labels + " --seed 0 --json");
  std::string text;
  run.read_line(text);
  return volumes_ml(nlohmann::json::parse(text));
}

}  // namespace traygauge
