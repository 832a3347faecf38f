// A dish as people describe it: in a capture's "dish", and in config/dishes.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "simulator/capture/json_node.hpp"

namespace traygauge {

// A point of the inner surface: how far inside the outer edge, and how high above the table.
struct ProfilePoint {
  double inset_mm = 0.0;
  double height_mm = 0.0;
};

// Heights above the table.
struct DishDescription {
  int label = 1;
  std::string style;
  std::array<double, 2> outer_size_mm{};
  double rim_height_mm = 0.0;
  double bottom_height_mm = 0.0;
  std::vector<ProfilePoint> profile;  // empty: a flat bottom
};

// Throws InputError. `label` is the caller's to read.
DishDescription read_dish(const JsonNode& node);

}  // namespace traygauge
