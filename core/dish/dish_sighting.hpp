// A dish as one view alone shows it: where its outer edge puts it on the table, and how large it looks.
//
// With the camera over the table known, the edge of a dish of known size and height says from a single
// picture where the dish stands. Two such sightings differ by the dish's own motion between the pictures, by
// what is wrong about scale, table and description, and by the errors of both cameras.
#pragma once

#include <array>
#include <span>

#include "core/dish/dish_search.hpp"
#include "core/dish/rim_residual.hpp"
#include "core/geometry/geometry.hpp"
#include "core/geometry/table_frame.hpp"

namespace traygauge {

struct DishSightingParams {
  // Neighbouring points of an outline repeat each other's error: so many count as one (see DishPoseParams).
  double points_for_one = 4.0;
  // Geman and McClure's scale, coarse to fine: the first as in DishPoseParams, the last three times the error
  // of an edge.
  std::array<double, 3> scales_px{25.0, 5.0, 1.0};
  int min_points = 24;  // which count as six, for three numbers of a place
  // Of the outline's points, that agree with one edge. A rim that is painted shows two: which of them a point
  // is on changes along it. Single edges of rendered dishes reach 0.93 and more, painted ones 0.89 at most.
  double min_agreeing = 0.92;
  int iterations = 6;  // of Gauss and Newton, with each scale
  // The edge of a dish that was found is also sought at these sizes: a card that is stated up to 7 % too
  // large makes it look so. Smaller ones would meet the bands of decorations.
  std::array<double, 3> larger_sizes{1.02, 1.04, 1.06};
  double least_larger = 0.01;  // of the described size: what is nearer is the same edge
};

// Centre (mm) and azimuth (rad) in the table frame, and by which share the dish looks larger than described.
inline constexpr int kSightedParameters = 4;
inline constexpr int kSightedSize = 3;
using SightedVector = Eigen::Matrix<double, kSightedParameters, 1>;
using SightedMatrix = Eigen::Matrix<double, kSightedParameters, kSightedParameters>;

// How the dish's edge leans against the table: by so many rad about the table's x and y, through its middle.
// To first order; the sighting's place and size give way. Floats: a tray's segmentation holds sixteen of
// them.
struct SightedLean {
  Eigen::Matrix2f information = Eigen::Matrix2f::Zero();  // 1 / rad², with the camera taken for exact
  Eigen::Vector2f weighted = Eigen::Vector2f::Zero();     // information · lean
  // What a step of the camera as in `moved` adds to `weighted`.
  Eigen::Matrix<float, 2, 6> by_camera = Eigen::Matrix<float, 2, 6>::Zero();
};

struct DishSighting {
  bool is_known = false;
  Pose camera_from_table;  // that it was seen from
  SightedVector place = SightedVector::Zero();
  SightedMatrix covariance = SightedMatrix::Zero();  // with camera and height taken for exact
  // Its answer to a step of the camera as in `moved`, and to a mm of the edge's height.
  Eigen::Matrix<double, kSightedParameters, 6> by_camera =
      Eigen::Matrix<double, kSightedParameters, 6>::Zero();
  SightedVector by_height = SightedVector::Zero();
  SightedLean lean;
  int points = 0;       // that agree
  double rms_px = 0.0;  // of those

  // As seen from a camera nearby.
  SightedVector place_from(const Pose& camera) const {
    return place + by_camera * step_between(camera_from_table, camera);
  }
};

// `outline`: rays on the dish's outline in one view. `about`: size and height as described, and roughly the
// place; the azimuth of a round dish stays as it is. Not known with too few points, or where they do not
// settle on one place.
DishSighting sight_dish(std::span<const Vec2> outline, const Pose& camera_from_table, double focal_px,
                        const DishPose& about, const DishSightingParams& params);

// Of a dish that was found, by its rim in each view alone; it may have slipped between the views. Leaves the
// rays that the sightings were made of in the workspace's rims, none unless both are known:
// an edge that is seen in one view contradicts what is drawn in the other.
std::array<DishSighting, 2> sight_found_dish(const DishSearchViews& views, const FoundDish& found,
                                             const DishSearchParams& search, const DishSightingParams& params,
                                             DishSearchWorkspace& workspace);

}  // namespace traygauge
