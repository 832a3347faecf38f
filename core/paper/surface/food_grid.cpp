#include "core/paper/surface/food_grid.hpp"

#include <cmath>

namespace traygauge::paper {
namespace {

constexpr int kGrowSteps = 32;       // 1.25^32 exceeds any picture's width
constexpr int kBisectionSteps = 16;  // below a hundredth of a pixel over any picture

// Pixels of one axis: the middle of each cell.
std::size_t place_line(int first, int end, double spacing, std::span<std::int32_t> line) {
  std::size_t count = 0;
  while (count < line.size()) {
    const int place = first + static_cast<int>((static_cast<double>(count) + 0.5) * spacing);
    if (place >= end) break;
    line[count++] = place;
  }
  return count;
}

int count_on_food(ImageView<const std::uint8_t> labels, const FoodGrid& grid) {
  int count = 0;
  for (const int y : grid.rows) {
    const std::uint8_t* row = labels.row(y);
    for (const int x : grid.columns) count += is_item(row[x]) ? 1 : 0;
  }
  return count;
}

FoodGrid place_grid(ImageView<const std::uint8_t> labels, const PixelBox& food, double spacing,
                    std::span<std::int32_t> columns, std::span<std::int32_t> rows) {
  FoodGrid grid;
  grid.spacing_px = spacing;
  grid.columns = columns.first(place_line(food.left, food.right, spacing, columns));
  grid.rows = rows.first(place_line(food.top, food.bottom, spacing, rows));
  grid.food_points = count_on_food(labels, grid);
  return grid;
}

}  // namespace

FoodGrid fit_food_grid(ImageView<const std::uint8_t> labels, const PixelBox& food, std::uint32_t food_pixels,
                       int max_points, std::span<std::int32_t> columns, std::span<std::int32_t> rows) {
  if (food_pixels <= static_cast<std::uint32_t>(max_points)) {
    return place_grid(labels, food, 1.0, columns, rows);
  }
  double fine = std::sqrt(food_pixels / static_cast<double>(max_points));
  double coarse = fine;
  FoodGrid grid = place_grid(labels, food, coarse, columns, rows);
  for (int i = 0; i < kGrowSteps && grid.food_points > max_points; ++i) {
    fine = coarse;
    coarse *= 1.25;
    grid = place_grid(labels, food, coarse, columns, rows);
  }
  // The mean count at `fine` is the cap or more; the count itself may fluctuate below it.
  fine = std::fmax(1.0, 0.8 * fine);
  double best_spacing = coarse;
  int best_count = grid.food_points;
  for (int i = 0; i < kBisectionSteps && best_count < max_points; ++i) {
    const double middle = 0.5 * (fine + coarse);
    const int count = place_grid(labels, food, middle, columns, rows).food_points;
    (count > max_points ? fine : coarse) = middle;
    if (count <= max_points && count > best_count) {
      best_count = count;
      best_spacing = middle;
    }
  }
  return place_grid(labels, food, best_spacing, columns, rows);
}

}  // namespace traygauge::paper
