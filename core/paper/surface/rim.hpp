// The plane of the dish's rim from its border in both views (paper III-C-2).
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/base/arena.hpp"
#include "core/base/bounded_list.hpp"
#include "core/base/random.hpp"
#include "core/base/status.hpp"
#include "core/dish/dish_contour.hpp"
#include "core/geometry/geometry.hpp"
#include "core/geometry/triangulation.hpp"
#include "core/image_view/image_view.hpp"
#include "core/paper/base/plane_fit.hpp"

namespace traygauge::paper {

struct RimParams {
  int step_sides = 3;      // every so many sides of the first border give a point
  ContourFitParams curve;  // subpixel place of the border
  // Where the border runs along the epipolar line the crossing is uncertain; 0.5 is 30 degrees.
  double min_crossing_sine = 0.5;
  PlaneFitParams plane;
  // Seen from outside, the near side's border is the outer wall below the edge, in each view another
  // line of it. The plane is fitted again without the points that either camera sees from further outside
  // than this; tangent of the angle between the line of sight and the rim's normal.
  double max_outward_tangent = 0.0;
  // … unless what is left fixes the plane's direction worse than the wall would spoil it.
  double max_edge_sigma_rad = 0.0035;
};

struct RimWorkspace {
  // The mean of so many sides stands for them when crossings are looked for: the staircase of single sides
  // would cross a slanted line several times.
  static constexpr std::size_t kBlockSides = 4;

  DishContour first;
  DishContour second;
  BoundedList<Vec2> second_blocks;  // mean places of a few consecutive sides of the second border
  BoundedList<Vec3> points_mm;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, std::size_t max_sides, std::size_t max_points) {
    first.allocate(arena, max_sides);
    second.allocate(arena, max_sides);
    second_blocks = BoundedList<Vec2>(arena.template take<Vec2>(max_sides / kBlockSides));
    points_mm = BoundedList<Vec3>(arena.template take<Vec3>(max_points));
  }
};

// Both working label pictures, whose dish is the labels 1…199.
struct RimInput {
  ImageView<const std::uint8_t> first_labels;
  ImageView<const std::uint8_t> second_labels;
  CameraPair cameras;
};

// Points on the rim, in the first camera, into `workspace.points_mm`: the borders of both label pictures,
// matched along epipolar lines. They meet the outer edge, or the outer wall below it where a steep view sees
// that on the near side. rim_not_found when there are fewer than the plane needs; no_dish_label,
// out_of_memory from the tracing.
Status collect_rim_points(const RimInput& input, const RimParams& params, RimWorkspace& workspace);

// The same from the depth of the first picture, just inside its border: points on the rim's crest.
Status collect_rim_crest(ImageView<const std::uint8_t> labels, ImageView<const float> depth_mm,
                         const PinholeCamera& camera, const RimParams& params, RimWorkspace& workspace);

// Standard deviation of a rim plane's direction about its weakest axis, from its residuals. Points whose
// fitted stretches of border overlap repeat each other's error.
double tilt_sigma_rad(const PlaneFit& fit, const RimParams& params);

// The plane of most rim points, normal towards the first camera. The first `fit.inliers` of `points_mm` are
// those that it rests on; the others that remain lie near it, on the near side's wall, and serve for the
// rim's size. rim_not_found when too few agree.
Status fit_rim_plane(const Pose& second_from_first, const RimParams& params, Random& random,
                     BoundedList<Vec3>& points_mm, PlaneFit& fit);

}  // namespace traygauge::paper
