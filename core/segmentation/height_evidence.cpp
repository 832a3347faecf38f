#include "core/segmentation/height_evidence.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/segmentation/square_sums.hpp"
#include "core/stereo/dish_projection.hpp"
#include "core/stereo/symmetric_census.hpp"

namespace traygauge {
namespace {

// Halves away from zero, as std::lround, which is a call.
int nearest_integer(double value) {
  return static_cast<int>(value + (value < 0.0 ? -0.5 : 0.5));
}

// The disparity of the dish's own surface where view `v` sees it.
class GlazeDisparity {
 public:
  GlazeDisparity(const PlaneRectification& grid, const InnerSurface& dish, int view, int step)
      : grid_(grid), dish_(dish), view_(view), step_(step) {}

  // Of one row, at every `step`th column; linear between.
  void load_row(int row, std::span<float> nodes) const {
    const Vec3& eye = grid_.camera_mm(view_);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const double column = static_cast<double>(i) * step_;
      const Vec3 sight = grid_.plane_point(row, column) - eye;
      const double z_mm = settled_height_mm(dish_, eye, sight.head<2>() / -sight.z());
      const double over_mm = z_mm - (eye.z() - grid_.camera_height_mm(view_));
      nodes[i] =
          static_cast<float>(view_ == 0 ? grid_.disparity(row, column, over_mm) : own(row, column, over_mm));
    }
  }

 private:
  // Of the second view's sample: the first view's column less its own, turned over.
  double own(int row, double column, double over_mm) const {
    double first = column;
    for (int i = 0; i < 3; ++i) first = column - grid_.disparity(row, first, over_mm);
    return column - first;
  }

  const PlaneRectification& grid_;
  const InnerSurface& dish_;
  int view_;
  int step_;
};

// Calls take(sample, mean) with twice the mean over the square about each sample.
template <class Take>
void average(std::span<const std::uint8_t> costs, int width, int height, int radius,
             HeightEvidenceWorkspace& workspace, Take&& take) {
  const int area = (2 * radius + 1) * (2 * radius + 1);
  const auto index = [&](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  };
  for_each_square_sum(
      width, height, radius, workspace.sums, workspace.column_sums,
      [&](int x, int y) { return costs[index(x, y)]; },
      [&](int x, int y, int sum) { take(index(x, y), static_cast<std::uint8_t>(2 * sum / area)); });
}

// The costs of one view's samples on the surface found and on the dish's own, and their heights.
void compare_view(std::size_t v, const std::array<SurfaceGrid, 2>& grids, const InnerSurface& dish,
                  const HeightEvidenceParams& params, HeightEvidenceStorage& storage,
                  HeightEvidenceWorkspace& workspace, HeightEvidence& relief) {
  const ImageView<HeightSample> samples = relief.views[v];
  const int width = samples.width;
  const int sign = v == 0 ? 1 : -1;
  const GlazeDisparity glaze(relief.grid, dish, static_cast<int>(v), params.node_step);
  const std::span<float> nodes =
      workspace.nodes.first(static_cast<std::size_t>((width - 1) / params.node_step) + 2);
  const SurfaceGrid& grid = grids[v];
  for (int y = 0; y < samples.height; ++y) {
    if (y % params.node_step == 0) glaze.load_row(y, nodes);
    const std::size_t row = static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
    const std::uint32_t* own = &workspace.codes[v][row];
    const std::uint32_t* other = &workspace.codes[1 - v][row];
    const float* found = &workspace.surface.views[v].surface[row];
    const auto cost_at = [&](int x, float d) {
      const int partner = x + sign * nearest_integer(static_cast<double>(d));
      const bool is_inside = partner >= 0 && partner < width;
      return static_cast<std::uint8_t>(is_inside ? std::popcount(own[x] ^ other[partner])
                                                 : kSymmetricCensusBits / 2);
    };
    for (int x = 0; x < width; ++x) {
      const float t = static_cast<float>(x % params.node_step) / static_cast<float>(params.node_step);
      const auto node = static_cast<std::size_t>(x / params.node_step);
      const std::size_t at = row + static_cast<std::size_t>(x);
      workspace.costs[0][at] = cost_at(x, found[x]);
      workspace.costs[1][at] = cost_at(x, (1.0F - t) * nodes[node] + t * nodes[node + 1]);
      HeightSample& sample = samples.at(x, y);
      sample = {};
      if (grid.labels.at(x, y) == 0 || grid.evidence.at(x, y) == SurfaceEvidence::none) continue;
      const SurfacePoint& point = grid.points.at(x, y);
      const double over_mm = static_cast<double>(point.z_mm) - dish.height_mm(Vec2(point.x_mm, point.y_mm));
      sample.height =
          static_cast<std::int8_t>(std::clamp(nearest_integer(over_mm / kHeightUnitMm), -127, 127));
      sample.is_known = true;
      sample.is_confirmed = grid.evidence.at(x, y) == SurfaceEvidence::both;
    }
  }
  constexpr int kRadius = 2;  // of the windows over which the census of the two views is compared
  const std::span<HeightSample> all = storage.samples[v];
  average(workspace.costs[0], width, samples.height, kRadius, workspace,
          [&](std::size_t at, std::uint8_t cost) { all[at].food_cost = cost; });
  average(workspace.costs[1], width, samples.height, kRadius, workspace,
          [&](std::size_t at, std::uint8_t cost) { all[at].glaze_cost = cost; });
}

}  // namespace

Status measure_height_evidence(const std::array<StoredView, 2>& views, const LabelTable& kept,
                               const InnerSurface& dish, const HeightEvidenceParams& params,
                               HeightEvidenceStorage& storage, HeightEvidenceWorkspace& workspace,
                               HeightEvidence& relief) {
  DenseStereoReport report;
  std::array<SurfaceGrid, 2> grids;
  const double bottom_mm = dish.profile.bottom_height_mm();
  Status status = run_dense_stereo(views, kept, bottom_mm, bottom_mm + params.highest_mm, params.surface,
                                   workspace.surface, grids, report);
  if (!status.ok()) return status;
  // The same grid in memory that is kept.
  status = relief.grid.build(views, kept, bottom_mm, params.surface.rectification, storage.rows);
  if (!status.ok()) return status;
  const int width = grids[0].labels.width;
  const int height = grids[0].labels.height;
  for (std::size_t v = 0; v < 2; ++v) {
    relief.views[v] = {storage.samples[v].data(), width, height};
    transform_symmetric_census(workspace.surface.views[v].gray[0],
                               {workspace.codes[v].data(), width, height});
  }
  for (std::size_t v = 0; v < 2; ++v) compare_view(v, grids, dish, params, storage, workspace, relief);
  return StatusCode::ok;
}

void lay_height_evidence(const HeightEvidence& relief, std::size_t view, const StoredView& stored,
                         const DishRaster& raster, ImageView<HeightSample> cells) {
  for (int y = 0; y < cells.height; ++y) std::fill_n(cells.row(y), cells.width, HeightSample{});
  const ImageView<HeightSample> samples = relief.views[view];
  const int footprint = static_cast<int>(std::ceil(relief.grid.column_step_mm() / raster.cell_mm + 0.2));
  const double before = 0.5 * (footprint - 1);
  for (int y = 0; y < samples.height; ++y) {
    for (int x = 0; x < samples.width; ++x) {
      const HeightSample& sample = samples.at(x, y);
      if (!sample.is_known) continue;
      const Vec3 point = stored.camera_from_table * relief.grid.plane_point(y, x);
      const Vec2 cell = raster.cell_of(stored.lens.pixel(point.hnormalized()));
      const int left = std::max(0, nearest_integer(cell.x() - before));
      const int top = std::max(0, nearest_integer(cell.y() - before));
      for (int j = top; j < std::min(top + footprint, cells.height); ++j) {
        for (int i = left; i < std::min(left + footprint, cells.width); ++i) cells.at(i, j) = sample;
      }
    }
  }
}

}  // namespace traygauge
