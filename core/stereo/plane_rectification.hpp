// Rectification over a horizontal plane of the table frame, here the dish's bottom. Both views are sampled at
// the same points of that plane, so what lies on it has no disparity (plane plus parallax, Irani & Anandan
// 1996). What lies above it moves along the lines through the point where the baseline meets the plane: a row
// is one such line, in both views at once, whatever the motion; columns count along it, so that neighbouring
// rows meet on arcs. Between views a surface is displaced by its height alone, not by its perspective, and
// both pictures of a surface parallel to the table have the same shape.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/status.hpp"
#include "core/base/units.hpp"
#include "core/geometry/camera.hpp"
#include "core/geometry/geometry.hpp"
#include "core/geometry/table_frame.hpp"
#include "core/image_view/image_view.hpp"
#include "core/labels/label_regions.hpp"
#include "core/labels/label_set.hpp"
#include "core/stereo/surface_grid.hpp"
#include "core/stereo/symmetric_census.hpp"

namespace traygauge {

inline constexpr int kMaxSamplesPerAxis = 3;  // of a picture, averaged for one sample of the grid

// Half or twice of any number here moves the MAPE of six pairs of the captures by 0.13 points at most
// (tests/evaluation/numbers.tsv), but for half of max_samples: 0.20. Half of max_rows refuses dishes.
struct PlaneRectificationParams {
  // Of the grid around the food: 2^17, to which the paper (V-B) resizes the dish, most of which is bare.
  // Time grows with them.
  int max_samples = 131072;
  double least_step_px = 1.0;  // of the finer picture, between samples: finer ones would show nothing more
  bool whole_dish = false;     // around the dish although food lies on it
  int max_rows = 768;          // that tables are kept for
  int margin_samples = 2 * kSymmetricCensusColumns;  // around the food, so that its outline matches
  double max_fan = 4.0;     // farthest over nearest sample, from the meeting point of the rows; beyond, the
                            // views are one behind the other and show no parallax
  int outline_step_px = 4;  // picture rows between those whose food sets the grid's extent
};

// One view as stored. `dish` holds every pixel whose label is kept.
struct StoredView {
  ImageView<const std::uint8_t> gray;
  ImageView<const std::uint8_t> labels;
  PixelBox dish;
  LensModel lens;
  Pose camera_from_table;
};

// Which labels belong to the dish that is measured: the label to write for each of the picture, 0 for others.
using LabelTable = std::array<std::uint8_t, kByteValues>;

// Of one dish with what lies on it: items keep their labels, the dish becomes kDishLabel.
LabelTable labels_on_dish(const LabelSet& on_dish);

// A row in the plane, mm of the table frame: origin + column * step.
struct PlaneRow {
  Vec2 origin_mm = Vec2::Zero();
  Vec2 direction = Vec2::Zero();    // unit, along the columns
  std::array<double, 2> foot_mm{};  // of either camera on the row, from the origin along it
};

class PlaneRectification {
 public:
  // Around what has an item's label among `kept`, or around the whole dish where it is bare or wanted.
  // rectification_failed when the cameras coincide, do not look down on the plane, see no dish, or the rows
  // fan out by more than max_fan. `rows` is memory for max_rows.
  Status build(const std::array<StoredView, 2>& views, const LabelTable& kept, double plane_height_mm,
               const PlaneRectificationParams& params, std::span<PlaneRow> rows);

  int rows() const { return static_cast<int>(rows_.size()); }
  int columns() const { return columns_; }
  double column_step_mm() const { return column_step_mm_; }
  double row_step_mm() const { return column_step_mm_; }  // in the middle of the grid
  const PlaneRow& row(int r) const { return rows_[static_cast<std::size_t>(r)]; }
  double camera_height_mm(int view) const { return camera_mm_[index(view)].z() - plane_height_mm_; }
  const Vec3& camera_mm(int view) const { return camera_mm_[index(view)]; }

  // Where a sample lies on the plane; every view's ray to it starts at camera_mm(view).
  Vec3 plane_point(double row, double column) const;

  // Column in view 1 less column in view 0 of the point `height_mm` above the plane that view 0 sees at a
  // sample; grows with the height.
  double disparity(int row, double column, double height_mm) const;

  // The point that view 0 sees at `first_column` and view 1 at `second_column`.
  SurfacePoint point(int row, double first_column, double second_column, int view) const;

  // `target` is columns() × rows(). The picture averaged over each sample; 0 outside of the picture.
  void sample_gray(const StoredView& source, ImageView<std::uint8_t> target) const;
  void sample_labels(const StoredView& source, const LabelTable& kept, ImageView<std::uint8_t> target) const;

 private:
  static constexpr std::size_t index(int i) { return static_cast<std::size_t>(i); }

  std::span<PlaneRow> rows_;
  int columns_ = 0;
  double column_step_mm_ = 1.0;
  double plane_height_mm_ = 0.0;
  std::array<Vec3, 2> camera_mm_{};
};

}  // namespace traygauge
