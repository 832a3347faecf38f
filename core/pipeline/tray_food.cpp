#include "core/pipeline/tray_food.hpp"

#include <algorithm>
#include <array>

#include "core/pipeline/dish_observation.hpp"
#include "core/pipeline/standing_object.hpp"
#include "core/pipeline/table_rectangle.hpp"
#include "core/stereo/surface_agreement.hpp"

namespace traygauge {
namespace {

// What an item may cover of the table, by the boxes around it in both pictures.
bool find_place(const TrayAtWork& tray, std::uint8_t label, TableRectangle& place) {
  for (std::size_t v = 0; v < 2; ++v) {
    const TrayView& view = *tray.views[v];
    const PixelBox& box = view.regions().boxes[label];
    const Pose& camera = tray.geometry.bundle.camera_from_table[v];
    if (!box.empty() && !include_box(view.lens, camera, box, 0.0, place)) return false;
  }
  return !place.empty();
}

// Over where the card puts the table.
AgreedHeight find_ground(const TrayAtWork& tray, const TableRectangle& place, const TrayFoodParams& params) {
  const TableCameras& cameras = tray.geometry.bundle.camera_from_table;
  const SurfaceView first = surface_view(*tray.views[0], cameras[0]);
  const SurfaceView second = surface_view(*tray.views[1], cameras[1]);
  const BareCheckParams& bare = tray.configuration.checks.bare;
  SurfaceAgreement ground(first, second, kBackgroundLabel,
                          {place.middle_mm().x(), place.middle_mm().y(), 0.0}, bare.agreement);
  const TableRectangle searched = place.grown(params.around_mm);
  const Vec2 steps = searched.size_mm() / bare.table_step_mm;
  for (int row = 0; row <= static_cast<int>(steps.y()); ++row) {
    for (int column = 0; column <= static_cast<int>(steps.x()); ++column) {
      const Vec2 at_mm = searched.least_mm + bare.table_step_mm * Vec2(column, row);
      ground.add({at_mm.x(), at_mm.y(), 0.0});
    }
  }
  return ground.solve();
}

Status measure_place(const TrayAtWork& tray, const TableRectangle& place, const LabelSet& labels,
                     std::uint8_t name) {
  const TrayFoodParams& params = tray.configuration.tray_food;
  for (const TrayView* view : tray.views) {
    if (is_cut_off(*view, labels)) return StatusCode::item_cut_off;
  }
  const AgreedHeight ground = find_ground(tray, place, params);
  const Vec2 size_mm = place.grown(params.map_margin_mm).size_mm();
  DishModel level;
  level.outer_size_mm = {size_mm.x(), size_mm.y()};
  level.bottom_height_mm = ground.is_known ? ground.offset_mm : 0.0;
  level.rim_height_mm = level.bottom_height_mm;
  FoodSurface surface{name, labels, {}, ground.is_known ? ground.sigma_mm : params.unknown_ground_sigma_mm};
  surface.inner.place.centre_mm = place.middle_mm();
  const Status status = surface.inner.profile.set(level);
  if (!status.ok()) return status;
  LabelTable kept = labels_on_dish(labels);
  kept[kBackgroundLabel] = kDishLabel;
  const Result<MatchedSurface> matched = match_on_surface(
      tray, surface, diffuse_views(tray.views, tray.geometry.bundle.camera_from_table, labels), kept);
  return matched.ok() ? measure_on_surface(tray, surface, *matched) : matched.status();
}

// What was found may lie in a dish that nobody described: a soup is as level as this, and as high.
bool may_fill_a_bowl(const TrayAtWork& tray, std::uint8_t label) {
  return tray.views[0]->are_outlines_found() &&
         find_standing_object(tray.views, tray.geometry, tray.configuration.card.size(),
                              tray.configuration.checks.standing, label)
             .is_seen;
}

}  // namespace

void measure_tray_food(const TrayAtWork& tray) {
  std::array<TableRectangle, kMaxItems> places;
  std::array<std::uint8_t, kMaxItems> labels;
  std::size_t items = 0;
  for (int value = kFirstItemLabel; value <= kLastItemLabel; ++value) {
    const auto label = static_cast<std::uint8_t>(value);
    if (!tray.geometry.beside_dishes.contains(label)) continue;
    places[items] = {};
    LabelSet only;
    only.add(label);
    if (may_fill_a_bowl(tray, label)) {
      tray.measurement.warnings.raise(Warning::unknown_object);
      refuse_items(tray, only, kFirstTrayPlace, StatusCode::dish_unknown);
    } else if (find_place(tray, label, places[items])) {
      labels[items++] = label;
    } else {
      refuse_items(tray, only, kFirstTrayPlace, StatusCode::labels_inconsistent);
    }
  }
  // Items that are near each other share a place, so that each is seen behind the other.
  std::array<std::size_t, kMaxItems> place_of;
  const std::size_t count = join_near(std::span(places).first(items), tray.configuration.tray_food.around_mm,
                                      std::span(place_of).first(items));
  for (std::size_t place = 0; place < count; ++place) {
    LabelSet own;
    for (std::size_t i = 0; i < items; ++i) {
      if (place_of[i] == place) own.add(labels[i]);
    }
    const auto name = static_cast<std::uint8_t>(kFirstTrayPlace + std::min(place, kMaxTrayPlaces - 1));
    const Status status =
        place < kMaxTrayPlaces ? measure_place(tray, places[place], own, name) : StatusCode::too_many_places;
    if (!status.ok()) refuse_items(tray, own, name, status);
  }
}

}  // namespace traygauge
