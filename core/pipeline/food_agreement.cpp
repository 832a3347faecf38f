#include "core/pipeline/food_agreement.hpp"

#include <cstdint>
#include <optional>

namespace traygauge {
namespace {

struct Count {
  int compared = 0;
  int agreed = 0;
};

void compare(const SurfaceGrid& grid, const SurfaceView& other, int step, Count& count) {
  for (int row = 0; row < grid.points.height; row += step) {
    for (int column = 0; column < grid.points.width; column += step) {
      const std::uint8_t label = grid.labels.at(column, row);
      if (!is_item(label) || grid.evidence.at(column, row) != SurfaceEvidence::both) continue;
      const SurfacePoint& point = grid.points.at(column, row);
      Vec2 pixel;
      if (!other.find_pixel({point.x_mm, point.y_mm, point.z_mm}, pixel)) continue;
      const std::optional<std::uint8_t> seen = other.label_at(pixel);
      if (!seen) continue;
      ++count.compared;
      count.agreed += *seen == label ? 1 : 0;
    }
  }
}

}  // namespace

double measure_food_agreement(const std::array<SurfaceGrid, 2>& grids, const ViewPair& views,
                              const TableCameras& camera_from_table, const FoodAgreementParams& params) {
  Count count;
  for (std::size_t v = 0; v < 2; ++v) {
    compare(grids[v], surface_view(*views[1 - v], camera_from_table[1 - v]), params.step, count);
  }
  return count.compared == 0 ? 1.0 : static_cast<double>(count.agreed) / count.compared;
}

}  // namespace traygauge
