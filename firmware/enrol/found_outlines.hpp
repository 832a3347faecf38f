// The label pictures of an empty dish that nobody outlined.
#pragma once

#include <array>
#include <string>

#include "simulator/capture/capture.hpp"

namespace traygauge {

// What a ruler says of a dish.
struct RuledDish {
  std::array<double, 2> outer_size_mm{};
  double rim_height_mm = 0.0;  // over the table
};

// "262x262x23": length, width and height of the rim, in mm. UsageError where that is no size of a dish.
RuledDish read_ruled_dish(const std::string& text);

// Outlines the rim in each view as the picture shows it there; the ruler only says where to look. Throws
// InputError where card or rim are not found.
std::array<Picture, 2> find_dish_outlines(const Capture& capture, std::array<int, 2> pair,
                                          const RuledDish& ruled);

}  // namespace traygauge
