// Where a dish stands on the table, and which of the known dishes it is, from its outlines in both views.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "core/base/bounded_list.hpp"
#include "core/base/status.hpp"
#include "core/dish/dish_model.hpp"
#include "core/dish/dish_pose_problem.hpp"
#include "core/dish/rim_ellipse.hpp"
#include "core/dish/rim_residual.hpp"
#include "core/geometry/geometry.hpp"
#include "core/geometry/table_frame.hpp"

namespace traygauge {

// 1 / mm², of what is described and held: a hundredth of a millimetre.
inline constexpr double kHeldInformation = 1e4;

// Half or twice of any number here moves the MAPE of six pairs of the captures by 0.06 points at most
// (tests/evaluation/numbers.tsv), but for edge_drop_mm: +0.15 and -0.08. Twice of min_inlier_fraction refuses
// right dishes.
struct DishPoseParams {
  // A point further off than about this counts as something else: a glass before the rim, a wall below it.
  // Geman and McClure's scale; taken from the points' median, at least this, at most the first of those
  // below.
  double min_robust_scale_px = 1.5;
  std::array<double, 3> first_robust_scales_px{25.0, 10.0, 5.0};  // while the place is not yet known
  // What a dish of a known kind may differ by: glaze and firing, feet, and a tray that is not level.
  double height_sigma_mm = 0.5;
  double size_sigma_mm = 0.5;
  // The upright side of the edge, as unsure as it is large: between a knife's edge and a thick rim.
  double edge_drop_mm = 1.0;
  int max_view_points = 120;         // that are read of each outline
  int min_points = 24;               // in both views together
  int min_view_points = 8;           // a view with fewer has no say
  double min_inlier_fraction = 0.5;  // of each view's points on the outline found; fewer contradict it
  double max_rms_px = 3.0;           // of those
  DishChoiceParams choice;
};

struct OutlineFit {
  int points = 0;
  int inliers = 0;
  // Off the outline but between the edge and the table below it, on the near side: a bowl's outer wall.
  int on_wall = 0;
  double rms_px = 0.0;  // of the inliers

  double explained_fraction() const { return static_cast<double>(inliers + on_wall) / std::max(1, points); }
};

struct PlacedDish {
  int candidate = -1;  // which of the described dishes
  DishPose place;
  PlaceMatrix covariance = PlaceMatrix::Zero();  // with the cameras taken for exact
  DishPose measured;                             // size and height as the outlines show them
  OutlineFit fit;
};

struct DishPoseWorkspace {
  BoundedList<Vec3> points_mm;
  std::span<double> magnitudes_px;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, std::size_t max_points) {
    points_mm = BoundedList<Vec3>(arena.template take<Vec3>(2 * max_points));
    magnitudes_px = arena.template take<double>(2 * max_points);
  }
};

// The ellipse through both outlines laid on the level `height_mm`; of every `step` points one is read. False
// when they lie on none.
bool guess_place(const DishOutlines& outlines, const TableCameras& cameras, double height_mm,
                 std::size_t step, DishPoseWorkspace& workspace, DishPose& place);

// The height of the edge that the outline shows.
double edge_height_mm(const DishModel& model);

// The prior of a dish of this kind, about whose azimuth nothing is known unless it is round.
PlacePrior prior_of(const DishModel& model, double azimuth_rad, const DishPoseParams& params);

// About a measured place, about whose azimuth little is known.
PlacePrior loose_prior(const DishPose& place, double height_sigma_mm, double size_sigma_mm,
                       const DishPoseParams& params);

// Whether one of the views that have a say contradicts the place found.
bool contradicts(const DishOutlines& outlines, const TableCameras& cameras, const FocalsPx& focals_px,
                 const DishPose& place, const DishPoseParams& params, DishPoseWorkspace& workspace);

// The robust scale for these outlines about this place; and, into `fit`, how well they agree.
double robust_scale_px(const DishOutlines& outlines, const TableCameras& cameras, const FocalsPx& focals_px,
                       const DishPose& place, const DishPoseParams& params, DishPoseWorkspace& workspace,
                       OutlineFit& fit);

// The same, and how many of the other points lie on a wall below the edge.
OutlineFit fit_of_outlines(const DishOutlines& outlines, const TableCameras& cameras,
                           const FocalsPx& focals_px, const DishPose& place, const DishPoseParams& params,
                           DishPoseWorkspace& workspace);

// Places the dish at given cameras. rim_not_found: too few points, or they lie on no ellipse;
// labels_inconsistent: no dish has both outlines; dish_unknown: the dish that has them is none of the
// candidates (`placed.measured` says what it is).
Status fit_dish_pose(const DishOutlines& outlines, const TableCameras& cameras, const FocalsPx& focals_px,
                     std::span<const DishModel> candidates, const DishPoseParams& params,
                     DishPoseWorkspace& workspace, PlacedDish& placed);

}  // namespace traygauge
