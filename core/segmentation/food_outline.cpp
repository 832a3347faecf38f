#include "core/segmentation/food_outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace traygauge {
namespace {

// Visits connected cells of equal value; four neighbours.
class Components {
 public:
  Components(ImageView<std::uint8_t> cells, std::span<std::int32_t> queue) : cells_(cells), queue_(queue) {}

  // Gives the component of `start` another value; returns its cells, in the order of the visit.
  std::span<const std::int32_t> repaint(int start, std::uint8_t value) {
    const std::uint8_t old = cells_.data[start];
    const int width = cells_.width;
    const int count = width * cells_.height;
    std::size_t size = 0;
    const auto take = [&](int cell) {
      if (cells_.data[cell] != old) return;
      cells_.data[cell] = value;
      queue_[size++] = cell;
    };
    if (old == value) return {};
    take(start);
    for (std::size_t i = 0; i < size; ++i) {
      const int cell = queue_[i];
      const int x = cell % width;
      if (x > 0) take(cell - 1);
      if (x + 1 < width) take(cell + 1);
      if (cell >= width) take(cell - width);
      if (cell + width < count) take(cell + width);
    }
    return queue_.first(size);
  }

 private:
  ImageView<std::uint8_t> cells_;
  std::span<std::int32_t> queue_;
};

constexpr std::uint8_t kVisited = 250;  // no label of a dish or item

// Repaints components of `from` with fewer cells than `min_cells`; they become `to`.
void drop_small(ImageView<std::uint8_t> cells, std::uint8_t from, std::uint8_t to, double min_cells,
                std::span<std::int32_t> queue) {
  Components components(cells, queue);
  const int count = cells.width * cells.height;
  for (int cell = 0; cell < count; ++cell) {
    if (cells.data[cell] != from) continue;
    const auto visited = components.repaint(cell, kVisited);
    if (static_cast<double>(visited.size()) >= min_cells) continue;
    for (const std::int32_t i : visited) cells.data[i] = to;
  }
  for (int cell = 0; cell < count; ++cell) {
    if (cells.data[cell] == kVisited) cells.data[cell] = from;
  }
}

// Majority of food against glaze over a square, by running sums along rows, then columns.
void smooth(ImageView<std::uint8_t> cells, int radius, std::span<std::uint8_t> sums) {
  const int width = cells.width;
  const int height = cells.height;
  const auto is_food = [&](int x, int y) {
    return cells.at(std::clamp(x, 0, width - 1), std::clamp(y, 0, height - 1)) == kFoodSeed ? 1 : 0;
  };
  const int side = 2 * radius + 1;
  for (int y = 0; y < height; ++y) {
    int sum = 0;
    for (int x = -radius; x <= radius; ++x) sum += is_food(x, y);
    for (int x = 0; x < width; ++x) {
      sums[static_cast<std::size_t>(y * width + x)] = static_cast<std::uint8_t>(sum);
      sum += is_food(x + radius + 1, y) - is_food(x - radius, y);
    }
  }
  for (int x = 0; x < width; ++x) {
    const auto row_sum = [&](int y) {
      return static_cast<int>(sums[static_cast<std::size_t>(std::clamp(y, 0, height - 1) * width + x)]);
    };
    int sum = 0;
    for (int y = -radius; y <= radius; ++y) sum += row_sum(y);
    for (int y = 0; y < height; ++y) {
      std::uint8_t& cell = cells.at(x, y);
      if (cell != kBarred) cell = 2 * sum > side * side ? kFoodSeed : kGlazeSeed;
      sum += row_sum(y + radius + 1) - row_sum(y - radius);
    }
  }
}

}  // namespace

int outline_food(const DishRaster& raster, const FoodOutlineParams& params, FoodOutlineWorkspace& workspace,
                 ImageView<std::uint8_t> labels) {
  GlazeColour glaze;
  if (!measure_glaze(raster, params.glaze, glaze)) return -1;
  const double cells_per_mm = 1.0 / params.raster.cell_mm;
  const ImageView<std::uint8_t> owners{workspace.owners.data(), raster.width(), raster.height()};
  seed_food(raster, glaze, params.glaze, owners);
  spread_owners(raster.colours, params.geodesic, workspace.geodesic, owners);
  smooth(owners, std::max(1, static_cast<int>(std::lround(params.smoothing_mm * cells_per_mm))),
         workspace.smoothed);
  const double per_mm2 = cells_per_mm * cells_per_mm;
  drop_small(owners, kFoodSeed, kGlazeSeed, params.min_item_mm2 * per_mm2, workspace.queue);
  drop_small(owners, kGlazeSeed, kFoodSeed, params.min_hole_mm2 * per_mm2, workspace.queue);

  const int count = raster.width() * raster.height();
  int items = 0;
  for (int cell = 0; cell < count; ++cell)
    labels.data[cell] = owners.data[cell] == kBarred ? kBackgroundLabel : kDishLabel;
  Components components(owners, workspace.queue);
  for (int cell = 0; cell < count && items <= kLastItemLabel - kFirstItemLabel; ++cell) {
    if (owners.data[cell] != kFoodSeed) continue;
    for (const std::int32_t i : components.repaint(cell, kVisited))
      labels.data[i] = static_cast<std::uint8_t>(kFirstItemLabel + items);
    ++items;
  }
  return items;
}

}  // namespace traygauge
