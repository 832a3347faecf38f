#include "firmware/station/site_scene.hpp"

#include <algorithm>
#include <utility>

#include "firmware/config/dish_choice.hpp"
#include "simulator/capture/label_specks.hpp"
#include "simulator/capture/picture_file.hpp"

namespace traygauge {
namespace {

// A few specks are painted over in silence: nobody is there to read of them at every start.
void read_labels(const InputFile& file, PictureSize size, Picture& labels) {
  labels = read_label_picture(file, size);
  std::vector<InputWarning> warnings;
  ignore_specks(file, labels, warnings);
}

}  // namespace

SiteScene::SiteScene(const StationFile& station, std::vector<DishDescription> library)
    : library_(std::move(library)) {
  require_geometry(station);
  const std::array<const LensConfig*, 2> lenses = {
      &*station.lens, station.second_lens ? &*station.second_lens : &*station.lens};
  for (std::size_t i = 0; i < 2; ++i) {
    if (station.labels) read_labels((*station.labels)[i], lenses[i]->camera.size, labels_[i]);
    setup_.lenses[i] = lens_of(lenses[i]->camera);
  }
  setup_.card = *station.card;
  setup_.pattern = load_pattern(*station.card);
  for (const DishDescription& dish : choose_tray_dishes(station, library_))
    setup_.dishes.push_back(dish_of(dish));
  Configuration parameters;
  parameters.segmentation.items = station.items;
  configuration_ = configure(setup_, parameters);
}

// A style that is not in the library leaves no dish, which the estimator refuses.
std::span<const DishModel> SiteScene::dishes(const TrayHint& hint) {
  if (hint.dishes.empty()) return configuration_.dishes;
  hinted_.clear();
  if (const auto named = find_dishes(hint.dishes, library_); named.ok()) {
    for (const DishDescription& dish : *named) hinted_.push_back(dish_of(dish));
  }
  return hinted_;
}

std::vector<std::string> SiteScene::dish_styles() const {
  std::vector<std::string> styles;
  for (const DishDescription& dish : library_) styles.push_back(dish.style);
  return styles;
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
