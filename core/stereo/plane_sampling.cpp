// The pictures at the samples of a plane rectification, through the lens.
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "core/geometry/lens_lanes.hpp"
#include "core/stereo/plane_rectification.hpp"

namespace traygauge {
namespace {

constexpr int kMaxSubSamples = kMaxSamplesPerAxis * kMaxSamplesPerAxis;
constexpr int kFractionBits = 7;  // of a position; weights then have 14 bits
constexpr int kPlaneUnit = 1 << kFractionBits;

// Picture positions of successive samples of a row.
struct Positions {
  std::array<float, kLensRun> x;
  std::array<float, kLensRun> y;
};

// A row in the camera: homogeneous, linear in the column.
struct CameraRow {
  Vec3 origin;
  Vec3 step;
};

CameraRow row_in_camera(const PlaneRow& row, const Pose& camera_from_table, double height_mm,
                        double step_mm) {
  const Vec3 origin(row.origin_mm.x(), row.origin_mm.y(), height_mm);
  const Vec3 step(row.direction.x() * step_mm, row.direction.y() * step_mm, 0.0);
  return {camera_from_table * origin, camera_from_table.rotation * step};
}

// In single precision, written to vectorise.
void compute_positions(const LensModel& lens, const CameraRow& row, int left, Positions& positions) {
  const Eigen::Vector3f first = (row.origin + left * row.step).cast<float>();
  const Eigen::Vector3f step = row.step.cast<float>();
  with_lens_lanes(lens, [&](const auto& lanes) {
    for (int i = 0; i < kLensRun; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const auto offset = static_cast<float>(i);
      const float inverse = 1.0F / (first.z() + offset * step.z());
      const LensLanes::Pixel pixel =
          lanes.pixel((first.x() + offset * step.x()) * inverse, (first.y() + offset * step.y()) * inverse);
      positions.x[at] = pixel.x;
      positions.y[at] = pixel.y;
    }
  });
}

// Offsets of the picture samples that are averaged for one of the grid.
struct PlaneSubGrid {
  std::array<int, kMaxSubSamples> x{};  // in 1 / kPlaneUnit px
  std::array<int, kMaxSubSamples> y{};
  int size = 0;
  int reach = 0;
};

PlaneSubGrid make_sub_grid(const Vec2& by_column, const Vec2& by_row, int max_per_axis) {
  const auto steps = [&](const Vec2& change) {
    return static_cast<int>(std::clamp(std::round(change.norm()), 1.0, static_cast<double>(max_per_axis)));
  };
  const int across = steps(by_column);
  const int down = steps(by_row);
  PlaneSubGrid grid;
  for (int j = 0; j < down; ++j) {
    for (int i = 0; i < across; ++i) {
      const Vec2 offset = by_column * ((i + 0.5) / across - 0.5) + by_row * ((j + 0.5) / down - 0.5);
      const auto at = static_cast<std::size_t>(grid.size++);
      grid.x[at] = static_cast<int>(std::lround(offset.x() * kPlaneUnit));
      grid.y[at] = static_cast<int>(std::lround(offset.y() * kPlaneUnit));
      grid.reach = std::max({grid.reach, std::abs(grid.x[at]), std::abs(grid.y[at])});
    }
  }
  return grid;
}

// Bilinear, scaled by kPlaneUnit².
std::uint32_t sample(ImageView<const std::uint8_t> picture, int x, int y) {
  const std::uint8_t* upper = picture.row(y >> kFractionBits) + (x >> kFractionBits);
  const std::uint8_t* lower = upper + picture.stride;
  const int right = x & (kPlaneUnit - 1);
  const int below = y & (kPlaneUnit - 1);
  const int top = (upper[0] << kFractionBits) + right * (upper[1] - upper[0]);
  const int bottom = (lower[0] << kFractionBits) + right * (lower[1] - lower[0]);
  return static_cast<std::uint32_t>((top << kFractionBits) + below * (bottom - top));
}

void sample_block(ImageView<const std::uint8_t> picture, const Positions& positions, const PlaneSubGrid& grid,
                  int count, std::uint8_t* out) {
  const int last_x = ((picture.width - 1) << kFractionBits) - 1;
  const int last_y = ((picture.height - 1) << kFractionBits) - 1;
  assert(grid.size > 0);
  const auto divisor = static_cast<std::uint32_t>(grid.size) << (2 * kFractionBits);
  const std::uint32_t half = divisor / 2;
  // One division a block instead of one a sample: exact for all sums below 2^26.
  // NOLINTNEXTLINE(clang-analyzer-core.DivideZero): a grid has at least one sample
  const std::uint64_t inverse = ((std::uint64_t{1} << 50) + divisor - 1) / divisor;
  for (int i = 0; i < count; ++i) {
    const float x_px = positions.x[static_cast<std::size_t>(i)];
    const float y_px = positions.y[static_cast<std::size_t>(i)];
    const bool inside = x_px >= 0.0F && y_px >= 0.0F && x_px <= static_cast<float>(picture.width - 1) &&
                        y_px <= static_cast<float>(picture.height - 1);
    if (!inside) {
      out[i] = 0;
      continue;
    }
    const auto x = static_cast<int>(x_px * kPlaneUnit + 0.5F);
    const auto y = static_cast<int>(y_px * kPlaneUnit + 0.5F);
    std::uint32_t sum = half;
    if (x >= grid.reach && y >= grid.reach && x + grid.reach <= last_x && y + grid.reach <= last_y) {
      for (std::size_t s = 0; s < static_cast<std::size_t>(grid.size); ++s) {
        sum += sample(picture, x + grid.x[s], y + grid.y[s]);
      }
    } else {
      for (std::size_t s = 0; s < static_cast<std::size_t>(grid.size); ++s) {
        sum += sample(picture, std::clamp(x + grid.x[s], 0, last_x), std::clamp(y + grid.y[s], 0, last_y));
      }
    }
    out[i] = static_cast<std::uint8_t>((sum * inverse) >> 50);
  }
}

}  // namespace

void PlaneRectification::sample_gray(const StoredView& source, ImageView<std::uint8_t> target) const {
  Positions positions;
  const auto position = [&](double row, double column) {
    const Vec3 ray = source.camera_from_table * plane_point(row, column);
    return source.lens.pixel(Vec2(ray.x() / ray.z(), ray.y() / ray.z()));
  };
  constexpr int most = kMaxSamplesPerAxis;
  for (int r = 0; r < rows(); ++r) {
    const CameraRow line = row_in_camera(row(r), source.camera_from_table, plane_height_mm_, column_step_mm_);
    for (int left = 0; left < columns_; left += kLensRun) {
      const int count = std::min(kLensRun, columns_ - left);
      compute_positions(source.lens, line, left, positions);
      // The map is linear enough over a block for one grid: its Jacobian there.
      const double middle = left + 0.5 * count;
      const int other = r + 1 < rows() ? r + 1 : std::max(r - 1, 0);
      const Vec2 here = position(r, middle);
      const PlaneSubGrid grid =
          make_sub_grid(position(r, middle + 1.0) - here, position(other, middle) - here, most);
      sample_block(source.gray, positions, grid, count, target.row(r) + left);
    }
  }
}

void PlaneRectification::sample_labels(const StoredView& source, const LabelTable& kept,
                                       ImageView<std::uint8_t> target) const {
  Positions positions;
  for (int r = 0; r < rows(); ++r) {
    const CameraRow line = row_in_camera(row(r), source.camera_from_table, plane_height_mm_, column_step_mm_);
    for (int left = 0; left < columns_; left += kLensRun) {
      const int count = std::min(kLensRun, columns_ - left);
      compute_positions(source.lens, line, left, positions);
      for (int i = 0; i < count; ++i) {
        const float x = positions.x[static_cast<std::size_t>(i)] + 0.5F;
        const float y = positions.y[static_cast<std::size_t>(i)] + 0.5F;
        const bool inside = x >= 0.0F && y >= 0.0F && x < static_cast<float>(source.labels.width) &&
                            y < static_cast<float>(source.labels.height);
        target.row(r)[left + i] =
            inside ? kept[source.labels.at(static_cast<int>(x), static_cast<int>(y))] : std::uint8_t{0};
      }
    }
  }
}

}  // namespace traygauge
