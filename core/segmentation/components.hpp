// Connected cells of a raster.
#pragma once

#include <cstdint>
#include <span>

#include "core/image_view/image_view.hpp"
#include "core/labels/label_regions.hpp"

namespace traygauge {

inline constexpr std::uint8_t kVisited = kLastFurtherDishLabel + 1;  // no label of a dish or item

// Visits connected cells of equal value; four neighbours.
class Components {
 public:
  Components(ImageView<std::uint8_t> cells, std::span<std::int32_t> queue) : cells_(cells), queue_(queue) {}

  // Gives the component of `start` another value; returns its cells, in the order of the visit.
  std::span<const std::int32_t> repaint(int start, std::uint8_t value);

 private:
  ImageView<std::uint8_t> cells_;
  std::span<std::int32_t> queue_;
};

// Repaints components of `from` with fewer cells than `min_cells`; they become `to`. Returns whether others
// are left.
bool drop_small(ImageView<std::uint8_t> cells, std::uint8_t from, std::uint8_t to, double min_cells,
                std::span<std::int32_t> queue);

// Cells of `through` become `from` where a path over `through` leads to `from`.
void spread_through(ImageView<std::uint8_t> cells, std::uint8_t from, std::uint8_t through,
                    std::span<std::int32_t> queue);

}  // namespace traygauge
