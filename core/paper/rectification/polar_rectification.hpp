// Polar rectification for any motion: Pollefeys, Koch, Van Gool 1999 (paper III-B-1, reference [31]).
// A rectified row is a pair of corresponding epipolar half-lines; a rectified column is the distance along
// the line, counted in each view from its dish pixel nearest to the baseline's direction (less the margin).
// Equal columns thus lie on one arc about the epipole, straight when that is at infinity, and buffers depend
// on the dish alone. The spacing of rows follows the outermost dish pixel of either view, row by row.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/arena.hpp"
#include "core/base/status.hpp"
#include "core/geometry/camera.hpp"
#include "core/geometry/geometry.hpp"
#include "core/image_view/image_view.hpp"
#include "core/paper/pose/relative_pose.hpp"
#include "core/paper/rectification/epipolar_view.hpp"
#include "core/paper/rectification/region_extent.hpp"

namespace traygauge::paper {

struct RectificationParams {
  int max_rows = 1024;    // rows of the rectified pictures that memory is kept for; dishes of 2^17 px take
                          // up to 720, and up to 1900 around an epipole in their middle (reduced then)
  int max_columns = 768;  // columns likewise; such dishes take up to 670
  double max_reduction = 2.0;  // px that one sample may stand for to keep within the caps; beyond: failure
  double margin_px = 8.0;      // around the dish: half a census and aggregation window, so that rims match
  double min_epipole_distance_px = 40.0;  // pixels nearer to an epipole are masked: they fan out too far
  int order_samples = 256;  // matches, evenly picked, whose pairs decide on mirroring; the paper takes all
};

// invalid_configuration when a value lies outside its range.
Status validate(const RectificationParams& params);

// One view: an undistorted picture's camera, and where the dish is (non-zero) in a picture of that size.
struct RectificationInput {
  PinholeCamera camera;
  ImageView<const std::uint8_t> region;
};

// Tables of one rectification, (72 max_rows + 16 order_samples) bytes.
struct RectificationWorkspace {
  std::span<double> angles;                          // of every row
  std::array<std::span<RectifiedLine>, 2> lines;     // of every row, in both views
  std::array<std::span<double>, 2> sampled_columns;  // of sampled matches

  template <class Allocator>
  constexpr void allocate(Allocator& arena, const RectificationParams& params) {
    const auto rows = static_cast<std::size_t>(params.max_rows);
    const auto samples = static_cast<std::size_t>(params.order_samples);
    angles = arena.template take<double>(rows);
    for (auto& table : lines) table = arena.template take<RectifiedLine>(rows);
    for (auto& table : sampled_columns) table = arena.template take<double>(samples);
  }
};

// Views are 0 and 1, pixels those of the working pictures. Disparity = column in view 1 − column in view 0:
// for a given pixel of view 0 it grows as the point comes nearer, unless mirrored.
class PolarRectification {
 public:
  // rectification_failed when the cameras coincide, no epipolar line crosses both dishes, or the caps would
  // reduce the pictures by more than max_reduction. `workspace` holds the tables until the next build.
  Status build(const RectificationInput& first, const RectificationInput& second,
               const Pose& second_from_first, std::span<const RayMatch> inliers,
               const RectificationParams& params, RectificationWorkspace& workspace);

  int rows() const { return static_cast<int>(angles_.size()); }
  int columns(int view) const { return views_[index(view)].columns; }
  bool mirrored() const { return mirrored_; }
  double pixels_per_sample() const { return pixels_per_sample_; }  // 1 unless the caps demand more

  // From rectified to working picture. The second form is for whole rows, and fast.
  Vec2 pixel(int view, double column, double row) const;
  Vec2 pixel_in_row(int view, double column, int row) const { return line(view, row).pixel(column); }
  const RectifiedLine& line(int view, int row) const { return views_[index(view)].lines[index(row)]; }

  // From working to rectified picture; false outside of it and near the epipole.
  bool rectified(int view, const Vec2& pixel, Vec2& column_row) const;

  // `target` is columns(view) × rows(). Bilinear, 0 outside the picture; labels by nearest neighbour.
  void rectify(int view, ImageView<const std::uint8_t> source, ImageView<std::uint8_t> target) const;
  void rectify_labels(int view, ImageView<const std::uint8_t> source, ImageView<std::uint8_t> target) const;

 private:
  struct View {
    EpipolarView geometry;
    Eigen::AlignedBox2d box;  // around the dish
    RegionExtent extent;
    double first_along = 0.0;  // distance_along of column 0
    double last_along = 0.0;
    int columns = 0;
    bool mirrored = false;
    std::span<RectifiedLine> lines;
  };

  static constexpr std::size_t index(int i) { return static_cast<std::size_t>(i); }
  bool set_up_geometry(const RectificationInput& first, const RectificationInput& second, const Pose& pose);
  bool find_angle_range(const RectificationParams& params);
  static bool find_column_range(View& view, const RectificationParams& params);
  double row_spacing(double angle) const;
  int count_rows(double pixels, int max_rows) const;
  bool choose_sampling(const RectificationParams& params);
  bool fill_rows(const RectificationParams& params, RectificationWorkspace& workspace);
  bool fill_lines(RectificationWorkspace& workspace);
  bool line_at(const View& view, double angle, RectifiedLine& line) const;
  bool is_order_inverted(std::span<const RayMatch> inliers, RectificationWorkspace& workspace) const;

  std::array<View, 2> views_;
  std::span<double> angles_;
  double min_angle_ = 0.0;
  double max_angle_ = 0.0;
  double max_spacing_ = 0.0;  // of rows, in radians
  double pixels_per_sample_ = 1.0;
  bool mirrored_ = false;
};

}  // namespace traygauge::paper
