// A dish as people describe it: in a capture's "dish", and in config/dishes.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace traygauge {

class JsonNode;

inline constexpr std::size_t kMaxDishes = 50;  // of a capture: labels 1 and 201 to 249

// A point of the inner surface: how far inside the outer edge, and how high above the table.
struct ProfilePoint {
  double inset_mm = 0.0;
  double height_mm = 0.0;
};

inline constexpr std::size_t kMaxProfilePoints = 32;

// Heights above the table.
struct DishDescription {
  int label = 1;
  std::string style;
  std::array<double, 2> outer_size_mm{};
  double rim_height_mm = 0.0;
  double bottom_height_mm = 0.0;
  // From the outer edge (inset 0) inward to the flat bottom, 2 to kMaxProfilePoints; empty: a flat bottom.
  std::vector<ProfilePoint> profile;
};

// Throws InputError. `label` is the caller's to read.
DishDescription read_dish(const JsonNode& node);

}  // namespace traygauge
