#include "firmware/enrol/empty_dish.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "core/labels/label_regions.hpp"
#include "firmware/measure/label_list.hpp"
#include "firmware/measure/view_reduction.hpp"

namespace traygauge {
namespace {

const ViewDescription& description_of(const Capture& capture, int index) {
  return capture.views[static_cast<std::size_t>(index)];
}

bool is_food_or_further_dish(std::size_t label) {
  return label >= kFirstItemLabel && label <= kLastFurtherDishLabel;
}

// Nobody enrols a dish with food in it.
LoadedView load_empty_dish(const ViewDescription& description) {
  LoadedView view = load_view(description);
  const std::string others = list_labels(view.labels, is_food_or_further_dish);
  if (!others.empty()) {
    throw InputError(*description.labels, "one empty dish: labels 0, 1 and 255",
                     "a dish that is not empty, labels " + others,
                     "take what is on it away and photograph the dish alone, with the card");
  }
  return view;
}

double to_hundredths(double value) {
  constexpr double kHundred = 100.0;
  return std::round(value * kHundred) / kHundred;
}

}  // namespace

EmptyDish::EmptyDish(const Capture& capture, std::array<int, 2> pair, const std::optional<RuledDish>& ruled)
    : setup_(set_up_pair(capture, pair, {})),
      block_(survey_bytes(configure(setup_))),
      surveyor_(block_.bytes(), configure(setup_)) {
  std::array<Picture, 2> outlines;
  if (ruled) outlines = find_dish_outlines(capture, pair, *ruled);
  for (std::size_t i = 0; i < 2; ++i) {
    const ViewDescription& description = description_of(capture, pair[i]);
    views_[i] = ruled ? load_view(description) : load_empty_dish(description);
    setup_.lenses[i] = lens_of(reduce_where_larger(views_[i], description.camera));
    if (ruled) views_[i].labels = std::move(outlines[i]);
  }
  if (surveyor_.status().ok()) return;
  throw InputError({capture.file, ""}, "a plausible camera and card", "values that contradict each other",
                   sentence(surveyor_.status().code()));
}

const DishSurvey& EmptyDish::survey(std::uint64_t seed) {
  surveyor_.reset();
  for (std::size_t i = 0; i < 2; ++i) {
    ViewInput input;
    input.frame = views_[i].picture.frame();
    input.labels = views_[i].labels.gray();
    input.lens = setup_.lenses[i];
    // survey() reports the failure of a view, too.
    if (!surveyor_.add_view(input).ok()) break;
  }
  return surveyor_.survey(seed);
}

DishDescription describe_dish(const DishModel& dish, const std::string& style) {
  DishDescription description;
  description.style = style;
  for (std::size_t axis = 0; axis < 2; ++axis)
    description.outer_size_mm[axis] = to_hundredths(dish.outer_size_mm[axis]);
  description.rim_height_mm = to_hundredths(dish.rim_height_mm);
  description.bottom_height_mm = to_hundredths(dish.bottom_height_mm);
  for (const DishProfilePoint& point : dish.profile())
    description.profile.push_back({to_hundredths(point.inset_mm), to_hundredths(point.height_mm)});
  return description;
}

}  // namespace traygauge
