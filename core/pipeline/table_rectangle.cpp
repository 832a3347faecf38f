#include "core/pipeline/table_rectangle.hpp"

#include <numeric>

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

std::size_t join_near(std::span<TableRectangle> places, double distance_mm, std::span<std::size_t> joined) {
  std::size_t count = places.size();
  std::iota(joined.begin(), joined.end(), std::size_t{0});
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = i + 1; j < count; ++j) {
      if (places[i].grown(distance_mm).shared_with(places[j]).empty()) continue;
      places[i].include(places[j]);
      places[j] = places[--count];  // the last one takes its number
      for (std::size_t& place : joined) {
        if (place == j)
          place = i;
        else if (place == count)
          place = j;
      }
      // What was apart from this one may be near now.
      i = 0;
      j = 0;
    }
  }
  return count;
}

}  // namespace traygauge
