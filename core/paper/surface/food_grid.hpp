// The regular grid over the food's pixels and the choice of its spacing.
#pragma once

#include <cstdint>
#include <span>

#include "core/image_view/image_view.hpp"
#include "core/labels/label_regions.hpp"

namespace traygauge::paper {

// Pixel columns × pixel rows; a grid point is a pixel, so its depth and ray are exact.
struct FoodGrid {
  double spacing_px = 1.0;
  std::span<const std::int32_t> columns;
  std::span<const std::int32_t> rows;
  int food_points = 0;  // grid points on items
};

// The grid of the smallest spacing ≥ 1 px that puts at most `max_points` points on items, by bisection.
// `food` bounds the items, `food_pixels` > 0 counts them; `columns` and `rows` hold the box's width and
// height.
FoodGrid fit_food_grid(ImageView<const std::uint8_t> labels, const PixelBox& food, std::uint32_t food_pixels,
                       int max_points, std::span<std::int32_t> columns, std::span<std::int32_t> rows);

}  // namespace traygauge::paper
