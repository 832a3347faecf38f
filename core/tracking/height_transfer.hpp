// Where a pixel of the first view appears in the second, if what it shows lies level at some height above the
// table.
#pragma once

#include "core/geometry/camera.hpp"
#include "core/geometry/table_frame.hpp"

namespace traygauge {

using Mat2 = Eigen::Matrix2d;

// The ray of a pixel in the table frame, and its derivatives by the pixel's coordinates.
struct TableRay {
  Vec2 in_camera = Vec2::Zero();  // z = 1
  Vec3 direction = Vec3::Zero();
  Vec3 along_x = Vec3::Zero();
  Vec3 along_y = Vec3::Zero();
};

// A pixel of the second view, and the affine map from the first view's surroundings to its own.
struct TransferredPixel {
  Vec2 pixel = Vec2::Zero();
  Mat2 second_from_first = Mat2::Identity();
};

class HeightTransfer {
 public:
  HeightTransfer(const LensModel& first, const LensModel& second, const TableCameras& camera_from_table);

  // False where the lens cannot be inverted.
  bool cast_ray(const Vec2& first_pixel, TableRay& ray) const;
  // False where the ray misses the height or the second camera does not look there.
  bool transfer(const TableRay& ray, double height_mm, TransferredPixel& transferred) const;
  bool transfer(const TableRay& ray, double height_mm, Vec2& pixel) const;
  // The point of the ray at this height, in the table frame.
  bool point_at(const TableRay& ray, double height_mm, Vec3& point_mm) const;

 private:
  bool project(const Vec3& point_mm, Vec2& pixel) const;

  LensModel first_;
  LensModel second_;
  Mat3 table_from_first_;  // rotation
  Vec3 first_centre_mm_;
  Pose second_from_table_;
};

}  // namespace traygauge
