#include "core/dish/dish_outline.hpp"

#include <algorithm>

namespace traygauge {
namespace {

// Mean place of the block; false where it is not the dish's own edge against the table.
bool average_block(const DishContour& contour, std::size_t begin, std::size_t count, std::uint8_t dish,
                   Vec2& mean_px) {
  mean_px = Vec2::Zero();
  for (std::size_t i = begin; i < begin + count; ++i) {
    const BorderSide& side = contour.sides[i];
    if (!side.against_table || side.label != dish) return false;
    mean_px += contour.place(i);
  }
  mean_px /= static_cast<double>(count);
  return true;
}

}  // namespace

Status trace_dish_outline(ImageView<const std::uint8_t> labels, const LensModel& lens,
                          const DishRegion& region, const DishOutlineParams& params,
                          DishOutlineWorkspace& workspace, BoundedList<Vec2>& rays) {
  rays.clear();
  const DishContour& contour = workspace.contour;
  const Status traced =
      trace_dish_contour(labels, region.on_dish, std::max(1, params.search_step), workspace.contour);
  if (!traced.ok()) return traced;
  const auto block = static_cast<std::size_t>(std::max(1, params.block_sides));
  for (std::size_t begin = 0; begin + block <= contour.sides.size(); begin += block) {
    Vec2 mean_px;
    Vec2 ray;
    if (!average_block(contour, begin, block, region.dish, mean_px)) continue;
    if (lens.undistort_pixel(mean_px, ray)) rays.push_back(ray);
  }
  return StatusCode::ok;
}

}  // namespace traygauge
