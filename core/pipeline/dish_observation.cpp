#include "core/pipeline/dish_observation.hpp"

#include <algorithm>
#include <cmath>

namespace traygauge {
namespace {

// Box of everything that has one of `labels`.
PixelBox box_of(const LabelRegions& regions, const LabelSet& labels) {
  PixelBox box;
  for (int value = 0; value < 256; ++value) {
    const auto label = static_cast<std::uint8_t>(value);
    if (labels.contains(label)) box = united(box, regions.boxes[label]);
  }
  return box;
}

ImageView<std::uint8_t> diffuse_of(const TrayView& view) {
  return {view.diffuse_storage.data, view.frame.width, view.frame.height};
}

}  // namespace

bool is_cut_off(const TrayView& view, const LabelSet& labels) {
  return view.regions().touches_edge(box_of(view.regions(), labels));
}

void suppress_speculars(const ViewPair& views, const SpecularParams& params) {
  for (const TrayView* view : views) suppress_specular(view->frame, params, diffuse_of(*view));
}

std::array<StoredView, 2> diffuse_views(const ViewPair& views, const TableCameras& camera_from_table,
                                        const LabelSet& labels) {
  std::array<StoredView, 2> stored;
  for (std::size_t v = 0; v < 2; ++v) {
    stored[v] = {diffuse_of(*views[v]), views[v]->labels, box_of(views[v]->regions(), labels), views[v]->lens,
                 camera_from_table[v]};
  }
  return stored;
}

DishFrame frame_of(const DishPose& place) {
  return {place.centre_mm, {std::cos(place.azimuth_rad), std::sin(place.azimuth_rad)}};
}

Vec3 middle_of(const DishPose& place, double height_mm) {
  return {place.centre_mm.x(), place.centre_mm.y(), height_mm};
}

double height_per_sample_mm(const TableCameras& camera_from_table, const Vec3& point_mm, double step_mm) {
  Vec2 shift = Vec2::Zero();  // on the level of the point, for a mm of height
  for (std::size_t v = 0; v < 2; ++v) {
    const Vec3 sight = point_mm - camera_centre_mm(camera_from_table[v]);
    shift += (v == 0 ? 1.0 : -1.0) * sight.head<2>() / -sight.z();
  }
  return step_mm / std::max(shift.norm(), 1e-3);
}

}  // namespace traygauge
