// One view of a pair in polar coordinates about the baseline. A half-plane bounded by the baseline cuts each
// picture in a half-line from its epipole; the angle of the half-plane names that pair of half-lines in both
// views at once and settles which half belongs to which (the oriented epipolar geometry of [31] section 3.1,
// from the pose instead of the fundamental matrix). The angle is a rotation in space: it stays well
// conditioned when the epipole moves to infinity and beyond.
#pragma once

#include "core/geometry/camera.hpp"
#include "core/geometry/geometry.hpp"

namespace traygauge::paper {

// A straight line in a picture: origin + column * step, in pixels.
struct RectifiedLine {
  Vec2 origin = Vec2::Zero();
  Vec2 step = Vec2::Zero();

  Vec2 pixel(double column) const { return origin + column * step; }
};

// Half-lines run from the direction of the other camera (of the first view) to the opposite one, in both
// views alike, so surfaces keep their order along them.
struct EpipolarView {
  PinholeCamera camera;
  Vec3 baseline = Vec3::UnitX();     // unit; from the first camera to the second, in this camera's frame
  Vec3 zero_angle = Vec3::UnitY();   // unit, orthogonal to the baseline
  Vec3 right_angle = Vec3::UnitZ();  // baseline × zero_angle
  Vec2 anchor_px = Vec2::Zero();     // where `distance_along` is zero

  // Angle of the half-plane through a pixel, in (−π, π].
  double angle(const Vec2& pixel) const;

  // |p − e| − |anchor − e| in pixels, positive away from the baseline's direction; written without the
  // difference, so that it turns into the distance along parallel lines when the epipole e is at infinity.
  double distance_along(const Vec2& pixel) const;

  // distance_along at `distance_px` from the epipole; infinite where the epipole is.
  double distance_along_at(double distance_px) const;

  // The half-line of an angle, with column 0 at `distance_along` = first and one pixel a column. False when
  // the camera does not see it.
  bool half_line(double angle, double first, RectifiedLine& line) const;

  // The angle between half-lines that are one pixel apart at their outermost point in a box.
  double angle_per_pixel(double angle, const Eigen::AlignedBox2d& box) const;

  // Homogeneous; the third coordinate is 0 at infinity and negative behind the camera.
  Vec3 epipole() const;

 private:
  Vec3 ray(const Vec2& pixel) const;
};

}  // namespace traygauge::paper
