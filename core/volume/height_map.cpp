#include "core/volume/height_map.hpp"

#include <algorithm>
#include <limits>

#include "core/base/result.hpp"
#include "core/volume/occluded_cells.hpp"
#include "core/volume/view_splat.hpp"

namespace traygauge {
namespace {

// The map around the dish's outer edge, without its memory.
Result<HeightMap> lay_out(const InnerSurface& dish, double cell_mm, std::size_t max_cells) {
  if (!(cell_mm > 0.0)) return StatusCode::invalid_configuration;
  if (!dish.place.centre_mm.allFinite() || !dish.place.axis.allFinite()) return StatusCode::wrong_call;
  const Vec2& semi = dish.profile.semi_axes_mm();
  const Vec2& axis = dish.place.axis;
  const Vec2 half(std::hypot(semi.x() * axis.x(), semi.y() * axis.y()),
                  std::hypot(semi.x() * axis.y(), semi.y() * axis.x()));
  const double width = std::ceil(2.0 * half.x() / cell_mm);
  const double height = std::ceil(2.0 * half.y() / cell_mm);
  if (!(width * height <= static_cast<double>(max_cells)) || width < 1.0 || height < 1.0 ||
      std::max(width, height) > std::numeric_limits<std::int16_t>::max()) {
    return StatusCode::out_of_memory;
  }
  HeightMap map;
  map.cell_mm = cell_mm;
  map.origin_mm = dish.place.centre_mm - 0.5 * cell_mm * Vec2(width - 1.0, height - 1.0);
  map.cells.width = static_cast<int>(width);
  map.cells.height = static_cast<int>(height);
  map.cells.stride = map.cells.width;
  return map;
}

// Slope of a view's line of sight to the dish's middle.
double sight_slope(const Vec3& camera_mm, const InnerSurface& dish) {
  const double run = (camera_mm.head<2>() - dish.place.centre_mm).norm();
  return (camera_mm.z() - dish.profile.bottom_height_mm()) / std::max(run, 1.0);
}

HeightCell fuse_surfaces(const HeightCell& a, const HeightCell& b, float disagreement_mm) {
  HeightCell fused = a.weight >= b.weight ? a : b;
  if (std::abs(a.z_mm - b.z_mm) <= disagreement_mm) {
    const float total = static_cast<float>(a.weight) + static_cast<float>(b.weight);
    fused.z_mm = (static_cast<float>(a.weight) * a.z_mm + static_cast<float>(b.weight) * b.z_mm) / total;
  }
  if (fused.below_label == 0) fused.below_label = a.weight >= b.weight ? b.below_label : a.below_label;
  return fused;
}

HeightCell fuse(const HeightCell& a, const HeightCell& b, float disagreement_mm) {
  if (a.kind == CellKind::unseen) return b;
  if (b.kind == CellKind::unseen) return a;
  if (a.kind != b.kind) {
    // Half a sample beyond its last sample a surface is as likely there as not; always the one view's word
    // keeps outlines without bias, where the surface's or the bound's would widen or narrow them.
    const HeightCell& surface = a.kind == CellKind::surface ? a : b;
    return surface.weight <= kExtrapolatedWeight ? a : surface;
  }
  if (a.kind == CellKind::surface) return fuse_surfaces(a, b, disagreement_mm);
  return a.z_mm <= b.z_mm ? a : b;  // both are bounds
}

}  // namespace

Status build_height_map(std::span<const SurfaceGrid> views, const InnerSurface& dish,
                        const HeightMapParams& params, std::span<HeightCell> cells,
                        HeightMapWorkspace& workspace, HeightMap& map) {
  map = {};
  const Result<HeightMap> laid_out =
      lay_out(dish, params.cell_mm, std::min(cells.size(), workspace.second.size()));
  if (!laid_out.ok()) return laid_out.status();
  map = *laid_out;
  map.cells.data = cells.data();
  HeightMap other = map;
  other.cells.data = workspace.second.data();
  double steepest_sight = 0.0;
  const auto disagreement_mm = static_cast<float>(params.disagreement_mm);
  bool seen = false;
  for (const SurfaceGrid& view : views) {
    if (view.points.empty() || view.evidence.width != view.points.width ||
        view.evidence.height != view.points.height || view.labels.width != view.points.width ||
        view.labels.height != view.points.height) {
      continue;
    }
    const auto grid_width = static_cast<std::size_t>(view.points.width);
    if (HeightMapWorkspace::kCornerRows * grid_width > workspace.corners.size())
      return StatusCode::out_of_memory;
    splat_view(view, params, workspace.corners, seen ? other : map);
    steepest_sight = std::max(steepest_sight, sight_slope(view.camera_mm, dish));
    for (int y = 0; seen && y < map.cells.height; ++y) {
      HeightCell* row = map.cells.row(y);
      std::transform(row, row + map.cells.width, other.cells.row(y), row,
                     [&](const HeightCell& a, const HeightCell& b) { return fuse(a, b, disagreement_mm); });
    }
    seen = true;
  }
  if (!seen) return StatusCode::too_little_depth;
  fill_occluded_cells(dish, params, steepest_sight, workspace.sources, map);
  return StatusCode::ok;
}

}  // namespace traygauge
