#include "simulator/scenes/tray_sets.hpp"

#include <algorithm>
#include <stdexcept>

#include "simulator/scenes/scene_parts.hpp"
#include "simulator/scenes/scene_series.hpp"
#include "simulator/scenes/scene_views.hpp"
#include "simulator/scenes/tray_layout.hpp"

namespace traygauge {
namespace {

constexpr double kOvalScale = 0.92;
constexpr double kDinnerScale = 0.95;

double plate_scale(DishStyle plate) {
  return plate == DishStyle::oval ? kOvalScale : kDinnerScale;
}

// Turning a tray shows it from another side only to a camera that looks at a slant.
constexpr ViewLimits kMovedViews{500.0, 720.0, 42.0, 8.0, 28.0};

// An arm turns by 20 degrees from the first view to the second.
constexpr double kArmMm = 700.0;
constexpr int kArmSteps = 4;
// Chosen: how differently a tray is pushed against a stop by hand.
constexpr double kPushMm = 8.0;
constexpr double kPushDeg = 1.5;

// What is the same for all trays of a station, with no food yet. Throws std::invalid_argument where no views
// show all of it.
SceneDescription lay_station(Draws draws, Menu& menu, Menu& soups, Menu& desserts) {
  const bool has_dessert = draws.chance(0.5);
  SceneDescription station = lay_tray("station", draws, has_dessert, menu.deal(2), soups, desserts);
  draw_arm_views(station, draws, kArmMm, kArmSteps);
  station.views = {station.views.front(), station.views.back()};
  station.pairs = {{0, 1}};
  draw_lamps(station, draws);
  draw_exposures(station, draws);
  station.foods.clear();
  return station;
}

// The first of many that a seed gives.
SceneDescription find_station(std::uint64_t seed, Menu& menu, Menu& soups, Menu& desserts) {
  constexpr int kTries = 50;
  for (int i = 1;; ++i) {
    try {
      return lay_station(Draws(seed, "station-40 " + std::to_string(i)), menu, soups, desserts);
    } catch (const std::invalid_argument&) {
      if (i == kTries) throw;
    }
  }
}

// Moves the tray in both views to where somebody pushed it.
void push_tray(SceneDescription& scene, Draws& draws) {
  const auto shows_all = [&scene](const Photograph& view) {
    return is_all_in_picture(scene, view) && !is_card_hidden(scene, view);
  };
  constexpr int kTries = 100;
  for (int i = 0; i < kTries; ++i) {
    const Eigen::Vector2d push_mm(draws.between(-kPushMm, kPushMm), draws.between(-kPushMm, kPushMm));
    const double push_deg = draws.between(-kPushDeg, kPushDeg);
    for (Photograph& view : scene.views) {
      view.tray_shift_mm = push_mm;
      view.tray_turn_deg = push_deg;
    }
    if (std::all_of(scene.views.begin(), scene.views.end(), shows_all)) return;
  }
  throw std::invalid_argument(scene.name + ": the tray does not stay in the pictures");
}

}  // namespace

SceneDescription lay_tray(const std::string& name, Draws draws, bool has_dessert,
                          std::span<const FoodKind* const> meal, Menu& soups, Menu& desserts) {
  SceneDescription scene = empty_scene(name, draws);
  draw_camera(scene, draws, kWideFocalPx);
  draw_tray(scene, draws);
  const DishStyle plate = draws.chance(0.5) ? DishStyle::oval : DishStyle::dinner;
  const bool is_deep_plate = draws.chance(0.4);
  scene.dishes = {
      draw_dish(draws, plate, plate_scale(plate), 1),
      draw_dish(draws, is_deep_plate ? DishStyle::soup : DishStyle::bowl, is_deep_plate ? 0.85 : 1.0, 201)};
  if (has_dessert) scene.dishes.push_back(draw_dish(draws, DishStyle::dessert_bowl, 1.0, 202));
  scene.card.thickness_mm = draws.chance(0.5) ? 0.8 : 0.2;
  scene.card.design = draws.seed();
  lay_out_tray(scene, draws);
  draw_foods(scene, draws, 0, plate, plate_scale(plate), meal);
  draw_filling(scene, draws, 1, *soups.deal(),
               is_deep_plate ? draws.between(0.45, 0.62) : draws.between(0.55, 0.78));
  if (has_dessert) draw_filling(scene, draws, 2, *desserts.deal(), draws.between(0.68, 0.85));
  return scene;
}

std::vector<SceneDescription> make_trays(std::uint64_t seed, const std::string& set, const char* letter,
                                         std::size_t count, bool is_moved) {
  Draws menu_draws(seed, set + " menu");
  Menu menu(menu_draws, {FoodGroup::canteen}, FoodServing::solid);
  Menu soups(menu_draws, {FoodGroup::canteen}, FoodServing::soup);
  Menu desserts(menu_draws, {FoodGroup::canteen}, FoodServing::dessert);
  return make_each(count, letter, set, seed, [&](std::size_t i, const std::string& name, Draws& draws) {
    const auto meal = menu.deal(2 + i % 2);
    SceneDescription scene = lay_tray(name, draws, !is_moved && i % 2 == 0, meal, soups, desserts);
    if (is_moved) {
      draw_moved_views(scene, draws, kMovedViews);
    } else {
      draw_views(scene, draws, 3, kTrayViews);
    }
    return scene;
  });
}

std::vector<SceneDescription> make_station(std::uint64_t seed) {
  constexpr std::size_t kTrays = 40;
  Draws menu_draws(seed, "station-40 menu");
  Menu menu(menu_draws, {FoodGroup::canteen, FoodGroup::fast_food}, FoodServing::solid);
  Menu soups(menu_draws, {FoodGroup::canteen}, FoodServing::soup);
  Menu desserts(menu_draws, {FoodGroup::canteen}, FoodServing::dessert);
  const SceneDescription station = find_station(seed, menu, soups, desserts);
  const DishStyle plate = station.dishes[0].dish.style == "oval" ? DishStyle::oval : DishStyle::dinner;
  std::vector<SceneDescription> scenes;
  for (std::size_t i = 0; i < kTrays; ++i) {
    const std::string name = numbered("k", i + 1);
    Draws draws(seed, "station-40 " + name);
    SceneDescription scene = station;
    scene.name = name;
    scene.seed = draws.seed();
    draw_foods(scene, draws, 0, plate, plate_scale(plate), menu.deal(2 + i % 2));
    draw_filling(scene, draws, 1, *soups.deal(), draws.between(0.5, 0.65));
    if (scene.dishes.size() > 2) draw_filling(scene, draws, 2, *desserts.deal(), draws.between(0.68, 0.85));
    push_tray(scene, draws);
    draws.shuffle(std::span<LaidFood>(scene.foods));  // labels tell nothing
    scenes.push_back(std::move(scene));
  }
  return scenes;
}

}  // namespace traygauge
