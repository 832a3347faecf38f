#include "core/pipeline/table_rectangle.hpp"

namespace traygauge {

bool include_box(const LensModel& lens, const Pose& camera_from_table, const PixelBox& box, double height_mm,
                 TableRectangle& rectangle) {
  const Pose table_from_camera = camera_from_table.inverse();
  const Vec3& camera_mm = table_from_camera.translation;
  for (const int x : {box.left, box.right - 1}) {
    for (const int y : {box.top, box.bottom - 1}) {
      Vec2 ray;
      if (!lens.undistort_pixel(Vec2(x, y), ray)) return false;
      const Vec3 direction = table_from_camera.rotation * ray.homogeneous();
      if (!(direction.z() < 0.0)) return false;
      const Vec3 point_mm = camera_mm + (height_mm - camera_mm.z()) / direction.z() * direction;
      rectangle.include({point_mm.head<2>(), point_mm.head<2>()});
    }
  }
  return true;
}

}  // namespace traygauge
