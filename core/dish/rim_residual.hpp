// How far a ray on a dish's outline passes by the outer edge of the dish.
//
// Seen from inside, the outline is the outer edge: an ellipse parallel to the table. Seen from outside, on
// the near side, it is the lower end of the edge's upright side, `edge_drop_mm` further down, and where a
// steep view sees the outer wall below, neither.
#pragma once

#include <array>

#include "core/geometry/geometry.hpp"

namespace traygauge {

// Where a dish stands, in the table frame, and how large its outer edge is.
struct DishPose {
  Vec2 centre_mm = Vec2::Zero();
  double azimuth_rad = 0.0;         // of the first axis, from the table's x towards its y
  double edge_height_mm = 0.0;      // of the outer edge over the table
  std::array<double, 2> size_mm{};  // whole axes of the outer edge
  double edge_drop_mm = 0.0;
};

// Where a step of a place has its parameters: centre and size take two each.
inline constexpr int kPlaceAzimuth = Vec2::SizeAtCompileTime;
inline constexpr int kPlaceHeight = kPlaceAzimuth + 1;
inline constexpr int kPlaceSize = kPlaceHeight + 1;
inline constexpr int kPlaceDrop = kPlaceSize + 2;
inline constexpr int kPlaceParameters = kPlaceDrop + 1;
// Cost of a place that a ray of its outline cannot see.
inline constexpr double kUnseenPlace = 1e30;
using PlaceVector = Eigen::Matrix<double, kPlaceParameters, 1>;
using PlaceMatrix = Eigen::Matrix<double, kPlaceParameters, kPlaceParameters>;

inline PlaceVector as_vector(const DishPose& place) {
  return (PlaceVector() << place.centre_mm, place.azimuth_rad, place.edge_height_mm, place.size_mm[0],
          place.size_mm[1], place.edge_drop_mm)
      .finished();
}

inline DishPose place_from_vector(const PlaceVector& v) {
  return {v.head<2>(), v[kPlaceAzimuth], v[kPlaceHeight], {v[kPlaceSize], v[kPlaceSize + 1]}, v[kPlaceDrop]};
}

// The place as seen from one camera: what all its residuals share.
class RimProjection {
 public:
  RimProjection(const DishPose& place, const Pose& camera_from_table, double focal_px);

  // The distance in the picture, to first order of it; positive outside. `by_camera` are the derivatives by a
  // step of the camera's pose as in `moved`. False when the ray does not come down to the edge's plane.
  bool residual(const Vec2& ray, double& residual_px) const;
  bool linearise(const Vec2& ray, double& residual_px, Eigen::Matrix<double, 6, 1>& by_camera,
                 PlaceVector& by_place) const;

 private:
  struct Crossing;
  bool cross(const Vec2& ray, Crossing& crossing) const;

  DishPose place_;
  Pose camera_from_table_;
  double focal_px_;
  Vec3 camera_mm_;
  double cosine_;
  double sine_;
};

}  // namespace traygauge
