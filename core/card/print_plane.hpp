// How the card's print lies under the picture for a pose.
#pragma once

#include <Eigen/LU>
#include <utility>

#include "core/card/card_size.hpp"
#include "core/geometry/geometry.hpp"
#include "core/geometry/table_frame.hpp"

namespace traygauge {

// The print near a ray; mm from its top left corner, right and down.
struct PrintPlace {
  Vec2 centre = Vec2::Zero();
  Eigen::Matrix2d by_ray = Eigen::Matrix2d::Zero();
  double depth = 0.0;  // along the optical axis, mm; 0: nowhere near the print

  bool valid() const { return depth > 0.0; }
};

// The map from rays to the print that a pose implies.
class PrintPlane {
 public:
  static constexpr double kMaxDistance = 4.0;  // from the print's centre, in half its width and height

  PrintPlane(Pose camera_from_table, const CardModelSize& size)
      : pose_(std::move(camera_from_table)), size_(size) {
    Mat3 ray_from_print;
    ray_from_print << pose_.rotation.col(0), -pose_.rotation.col(1),
        pose_.rotation.col(2) * size.thickness_mm + pose_.translation;
    print_from_ray_ = ray_from_print.inverse();
  }

  PrintPlace place(const Vec2& ray) const {
    PrintPlace place;
    const Vec3 mapped = print_from_ray_ * ray.homogeneous();
    if (!(mapped.z() > 0.0) || mapped.z() > 1.0 / kNearMm) return place;
    place.centre = mapped.head<2>() / mapped.z();
    if (!(normalised(place.centre).cwiseAbs().maxCoeff() < kMaxDistance)) return place;
    place.by_ray =
        (print_from_ray_.topLeftCorner<2, 2>() - place.centre * print_from_ray_.block<1, 2>(2, 0)) /
        mapped.z();
    place.depth = 1.0 / mapped.z();
    return place;
  }

  // Where the print under a fixed ray moves with the pose's step (`moved`).
  Eigen::Matrix<double, 2, 6> print_by_step(const PrintPlace& place, const Vec2& ray) const {
    const Vec3 turned = pose_.rotation * print_point_mm(place.centre, size_.thickness_mm);
    Eigen::Matrix<double, 2, 6> ray_by_step;
    for (int row = 0; row < 2; ++row) {
      const Vec3 by_point = (Vec3::Unit(row) - ray(row) * Vec3::UnitZ()) / place.depth;
      ray_by_step.row(row) << turned.cross(by_point).transpose(), by_point.transpose();
    }
    return -place.by_ray * ray_by_step;
  }

  // Where the print under a fixed ray moves, in mm, as the card there rises by a mm.
  Vec2 print_by_height(const Vec2& ray) const {
    const Vec3 along = pose_.rotation.transpose() * ray.homogeneous();
    return {along.x() / along.z(), -along.y() / along.z()};
  }

  // −1 to 1 over the card.
  Vec2 normalised(const Vec2& print_mm) const {
    return {2.0 * print_mm.x() / size_.width_mm - 1.0, 2.0 * print_mm.y() / size_.height_mm - 1.0};
  }

 private:
  Pose pose_;
  CardModelSize size_;
  Mat3 print_from_ray_;
};

}  // namespace traygauge
