#include "core/pipeline/food_agreement.hpp"

#include <cmath>

namespace traygauge {
namespace {

struct Count {
  int compared = 0;
  int agreed = 0;
};

// The stored pixel that shows a point; false outside of the picture.
bool find_pixel(const Vec3& point_mm, const Pose& camera_from_table, const TrayView& view, int& x, int& y) {
  const Vec3 seen = camera_from_table * point_mm;
  if (!(seen.z() > 0.0)) return false;
  const Vec2 pixel = view.lens.pixel(seen.hnormalized());
  if (!(std::abs(pixel.x()) < 1e6 && std::abs(pixel.y()) < 1e6)) return false;
  x = static_cast<int>(std::lround(pixel.x()));
  y = static_cast<int>(std::lround(pixel.y()));
  return view.labels.contains(x, y);
}

void compare(const SurfaceGrid& grid, const TrayView& other, const Pose& other_from_table, int step,
             Count& count) {
  for (int row = 0; row < grid.points.height; row += step) {
    for (int column = 0; column < grid.points.width; column += step) {
      const std::uint8_t label = grid.labels.at(column, row);
      if (!is_item(label) || grid.evidence.at(column, row) != SurfaceEvidence::both) continue;
      const SurfacePoint& point = grid.points.at(column, row);
      int x = 0;
      int y = 0;
      if (!find_pixel({point.x_mm, point.y_mm, point.z_mm}, other_from_table, other, x, y)) continue;
      ++count.compared;
      count.agreed += other.labels.at(x, y) == label ? 1 : 0;
    }
  }
}

}  // namespace

double measure_food_agreement(const std::array<SurfaceGrid, 2>& grids, const ViewPair& views,
                              const TableCameras& camera_from_table, const FoodAgreementParams& params) {
  Count count;
  for (std::size_t v = 0; v < 2; ++v) {
    compare(grids[v], *views[1 - v], camera_from_table[1 - v], params.step, count);
  }
  return count.compared == 0 ? 1.0 : static_cast<double>(count.agreed) / count.compared;
}

}  // namespace traygauge
