// How the items that were found become as many as a menu says.
#include <array>
#include <limits>
#include <span>

#include "core/base/units.hpp"
#include "core/pipeline/segmenter.hpp"
#include "core/quality/region_colours.hpp"

namespace traygauge {
namespace {

// What taking two items for one costs: the growth of the squared deviations (Ward 1963) of their light, in
// shares of it. Exposure alone counts for less than hue.
double cost_of(const RegionColour& a, const RegionColour& b) {
  const auto step = [](double x, double y) { return 2.0 * (x - y) / (x + y); };
  const double light = step(a.green, b.green);
  const double red = step(a.red, b.red) - light;
  const double blue = step(a.blue, b.blue) - light;
  constexpr double kLightWeight = 0.25;  // of squares: shadows, beside another hue
  const double pixels =
      static_cast<double>(a.samples) * b.samples / (static_cast<double>(a.samples) + b.samples);
  return pixels * (kLightWeight * light * light + red * red + blue * blue);
}

}  // namespace

// Too few: borders that are weaker and weaker separate, down to a strength below which they are none; without
// success what was found stands. Too many: parts that are less and less alike join, as long as enough are
// left; then those on one dish that resemble each other most are one.
void Segmenter::meet_hint() {
  FoodOutlineParams food = params_.food;
  double& likeness = food.split.likeness.constant;
  PartDifferenceParams& difference = food.split.difference;
  if (result_.items < params_.items) {
    while (result_.items < params_.items &&
           difference.colour > params_.weakest_border * params_.food.split.difference.colour) {
      difference.colour *= params_.border_step;
      difference.embedding *= params_.border_step;
      likeness -= params_.likeness_step;
      draw_items(food);
    }
    if (result_.items < params_.items) draw_items(params_.food);
  } else if (result_.items > params_.items) {
    while (result_.items > params_.items &&
           likeness < params_.food.split.likeness.constant + params_.most_likeness) {
      likeness += params_.likeness_step;
      draw_items(food);
    }
    if (result_.items < params_.items) {
      likeness -= params_.likeness_step;
      draw_items(food);
    }
  }
  while (result_.items > params_.items && join_most_alike()) {
  }
}

bool Segmenter::join_most_alike() {
  const SegmentedView& view = views_[0];
  RegionColours colours;
  measure_region_colours(view.frame, view.labels, configuration_.view_checks.colours, colours);
  double least = std::numeric_limits<double>::infinity();
  std::size_t kept = 0;
  std::size_t joined = 0;
  SegmentedDish* on = nullptr;
  auto end = static_cast<std::size_t>(kFirstItemLabel);
  for (SegmentedDish& dish : result_.drawn()) {
    const std::size_t begin = end;
    end += static_cast<std::size_t>(dish.items);
    for (std::size_t a = begin; a < end; ++a) {
      for (std::size_t b = a + 1; b < end; ++b) {
        if (colours[a].samples == 0 || colours[b].samples == 0) continue;
        const double cost = cost_of(colours[a], colours[b]);
        if (cost >= least) continue;
        least = cost;
        kept = a;
        joined = b;
        on = &dish;
      }
    }
  }
  if (on == nullptr) return false;
  std::array<std::uint8_t, kByteValues> renamed{};
  for (std::size_t label = kFirstItemLabel; label < end; ++label)
    renamed[label] = static_cast<std::uint8_t>(label > joined ? label - 1 : label);
  renamed[joined] = static_cast<std::uint8_t>(kept);
  rename_items(kFirstItemLabel, result_.items, renamed);
  --on->items;
  --result_.items;
  return true;
}

}  // namespace traygauge
