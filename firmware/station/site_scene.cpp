#include "firmware/station/site_scene.hpp"

#include <algorithm>

#include "simulator/capture/picture_file.hpp"

namespace traygauge {

SiteScene::SiteScene(const StationFile& station, const std::vector<DishDescription>& dishes) {
  require_geometry(station);
  const std::array<const LensConfig*, 2> lenses = {
      &*station.lens, station.second_lens ? &*station.second_lens : &*station.lens};
  for (std::size_t i = 0; i < 2; ++i) {
    if (station.labels) labels_[i] = read_label_picture((*station.labels)[i], lenses[i]->camera.size);
    setup_.lenses[i] = lens_of(lenses[i]->camera);
  }
  setup_.card = *station.card;
  setup_.pattern = load_pattern(*station.card);
  for (const DishDescription& dish : dishes) setup_.dishes.push_back(dish_of(dish));
  Configuration parameters;
  parameters.segmentation.items = station.items;
  configuration_ = configure(setup_, parameters);
}

ViewInput SiteScene::describe(const StationView& view) {
  ViewInput input;
  input.frame = view.frame;
  const std::size_t i = std::min<std::size_t>(views_, 1);
  if (!needs_labels()) input.labels = labels_[i].gray();
  input.lens = setup_.lenses[i];
  input.arm_angle_deg = view.arm_angle_deg;
  ++views_;
  return input;
}

}  // namespace traygauge
