// A small shape of a scan as a station composes it.
#pragma once

#include <nlohmann/json.hpp>

#include "firmware/base/scan_id.hpp"

namespace traygauge::test {

// Three by two cells: one of which nothing is known, two of the dish, three of food 2.
inline nlohmann::json sample_shape(const ScanId& id) {
  using Json = nlohmann::json;
  const Json dish = {{"dish", 1},
                     {"cell_mm", 2.5},
                     {"columns", 3},
                     {"rows", 2},
                     {"origin_mm", {10.0, 20.0}},
                     {"surface_tenth_mm", {nullptr, 100, 105, 200, 210, 220}},
                     {"inner_tenth_mm", {nullptr, 100, 105, 100, 100, 100}},
                     {"labels", {0, 0, 0, 2, 2, 2}}};
  const Json outline = {{"label", 2},
                        {"dish", 1},
                        {"points_mm", {{8.75, 21.25}, {16.25, 21.25}, {16.25, 23.75}, {8.75, 23.75}}}};
  return {{"id", scan_id_text(id)}, {"dishes", Json::array({dish})}, {"outlines", Json::array({outline})}};
}

}  // namespace traygauge::test
