#include "simulator/scenes/training_set.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <string>

#include "simulator/scenes/draws.hpp"
#include "simulator/scenes/scene_menu.hpp"
#include "simulator/scenes/scene_parts.hpp"
#include "simulator/scenes/thing_layout.hpp"
#include "simulator/scenes/training_dishes.hpp"
#include "simulator/scenes/training_light.hpp"
#include "simulator/scenes/tray_layout.hpp"

namespace traygauge {
namespace {

constexpr int kScenes = 24;
constexpr int kViews = 4;
constexpr double kFocalPx = 1300.0;

constexpr std::array kTrainingTables = {SurfaceKind::wood, SurfaceKind::laminate, SurfaceKind::cloth,
                                        SurfaceKind::plastic};

// Decks of foods; those of meals-14 are in none.
struct Menus {
  explicit Menus(Draws& draws)
      : pale(draws, {FoodGroup::training}, FoodServing::solid),
        usual(draws, {FoodGroup::canteen, FoodGroup::fast_food}, FoodServing::solid),
        soups(draws, {FoodGroup::canteen, FoodGroup::training}, FoodServing::soup),
        desserts(draws, {FoodGroup::canteen, FoodGroup::training}, FoodServing::dessert) {}

  // More than half of them pale, all different.
  std::vector<const FoodKind*> deal(Draws& draws, std::size_t count) {
    std::vector<const FoodKind*> hand;
    while (hand.size() < count) {
      const FoodKind* kind = draws.chance(0.6) ? pale.deal() : usual.deal();
      if (std::find(hand.begin(), hand.end(), kind) == hand.end()) hand.push_back(kind);
    }
    return hand;
  }

  Menu pale, usual, soups, desserts;
};

template <std::size_t kCount>
const FoodKind& pick_food(Draws& draws, const std::array<std::string_view, kCount>& names) {
  return *find_food_kind(draws.pick(std::span<const std::string_view>(names)));
}

const FoodKind& salad_of(Draws& draws) {
  return pick_food(draws,
                   std::to_array<std::string_view>({"salad", "salad", "coleslaw", "red_cabbage", "feta_cubes",
                                                    "diced_vegetables", "peas", "egg_halves"}));
}

const FoodKind& on_side_plate(Draws& draws) {
  return pick_food(draws,
                   std::to_array<std::string_view>({"bread_roll", "white_roll", "bread", "cake", "cheesecake",
                                                    "panna_cotta", "mozzarella_slices", "egg_halves"}));
}

// Fills a small dish with what is usual in it.
void serve_in_small(SceneDescription& scene, Draws& draws, Menus& menus, int dish, SmallDish kind) {
  switch (kind) {
    case SmallDish::side_plate:
    case SmallDish::dessert_plate:
      draw_middle_food(scene, draws, dish, draws.chance(0.6) ? on_side_plate(draws) : *menus.pale.deal());
      return;
    case SmallDish::salad_bowl:
      if (draws.chance(0.2)) break;
      draw_middle_food(scene, draws, dish, salad_of(draws));
      return;
    case SmallDish::ramekin:
      break;
  }
  draw_filling(scene, draws, dish, *menus.desserts.deal(), draws.between(0.4, 0.85));
}

void lay_meal(SceneDescription& scene, Draws& draws, Menus& menus) {
  constexpr std::array kPlates = {DishStyle::dinner, DishStyle::soup, DishStyle::oval};
  const DishStyle style = draws.pick(std::span<const DishStyle>(kPlates));
  const double scale = draws.between(0.88, 1.1);
  scene.dishes.push_back(draw_dish(draws, style, scale, 1));
  draw_training_glaze(draws, scene.dishes.back().glaze);
  const auto kinds = menus.deal(draws, static_cast<std::size_t>(draws.whole(1, 3)));
  draw_foods(scene, draws, 0, style, scale, kinds);
  lay_card_beside(scene, draws);
}

void lay_small_dish(SceneDescription& scene, Draws& draws, Menus& menus, SmallDish kind) {
  scene.dishes.push_back(draw_small_dish(draws, kind, 1));
  serve_in_small(scene, draws, menus, 0, kind);
  lay_card_beside(scene, draws);
}

// A plate, a bowl with salad or soup, and on most something sweet or a roll.
void lay_tray(SceneDescription& scene, Draws& draws, Menus& menus) {
  constexpr std::array kTops = {SurfaceKind::plastic, SurfaceKind::wood, SurfaceKind::laminate};
  scene.tray = Tray{{draws.between(580.0, 630.0), draws.between(420.0, 450.0)},
                    draws.pick(std::span<const SurfaceKind>(kTops)),
                    draws.seed()};
  const DishStyle plate = draws.chance(0.4) ? DishStyle::oval : DishStyle::dinner;
  const double scale = plate == DishStyle::oval ? 0.8 : 0.84;
  scene.dishes.push_back(draw_dish(draws, plate, scale, 1));
  draw_training_glaze(draws, scene.dishes.back().glaze);
  const bool has_soup = draws.chance(0.3);
  if (has_soup) {
    scene.dishes.push_back(draw_dish(draws, DishStyle::bowl, 1.0, 201));
    draw_training_glaze(draws, scene.dishes.back().glaze);
  } else {
    scene.dishes.push_back(draw_small_dish(draws, SmallDish::salad_bowl, 201));
  }
  constexpr std::array kSmall = {SmallDish::side_plate, SmallDish::dessert_plate, SmallDish::ramekin};
  const bool has_third = draws.chance(0.7);
  const SmallDish third = draws.pick(std::span<const SmallDish>(kSmall));
  if (has_third) scene.dishes.push_back(draw_small_dish(draws, third, 202));
  scene.card.thickness_mm = draws.chance(0.5) ? 0.8 : 0.2;
  scene.card.design = draws.seed();
  lay_out_tray(scene, draws);
  const auto kinds = menus.deal(draws, static_cast<std::size_t>(draws.whole(1, 3)));
  draw_foods(scene, draws, 0, plate, scale, kinds);
  if (has_soup)
    draw_filling(scene, draws, 1, *menus.soups.deal(), draws.between(0.45, 0.8));
  else
    serve_in_small(scene, draws, menus, 1, SmallDish::salad_bowl);
  if (has_third) serve_in_small(scene, draws, menus, 2, third);
}

// From above to far aside, from near, where a dish fills the picture and more, to far.
void draw_training_views(SceneDescription& scene, Draws& draws, double extent_mm) {
  for (int i = 0; i < kViews; ++i) {
    Photograph view;
    const double play_mm = 0.2 * extent_mm;
    view.target_mm = {draws.between(-play_mm, play_mm), draws.between(-play_mm, play_mm), 0.0};
    view.distance_mm = draws.between(1.2, 2.4) * extent_mm;
    view.tilt_deg = draws.between(0.0, 60.0);
    view.azimuth_deg = draws.between(0.0, 360.0);
    view.roll_deg = draws.between(-20.0, 20.0);
    scene.views.push_back(view);
    for (int k = 0; k < i; ++k) scene.pairs.push_back({k, i});
  }
}

SceneDescription lay_scene(int number, Draws& draws, Menus& menus) {
  SceneDescription scene;
  scene.name = (number < 9 ? "l0" : "l") + std::to_string(number + 1);
  scene.seed = draws.seed();
  draw_camera(scene, draws, kFocalPx);
  scene.table = {draws.pick(std::span<const SurfaceKind>(kTrainingTables)), draws.between(0.0, 180.0),
                 draws.seed()};
  double extent_mm = 400.0;
  int most_things = 3;
  if (number % 3 == 0) {
    lay_meal(scene, draws, menus);
    extent_mm = scene.dishes.front().dish.outer_size_mm[0];
  } else if (number % 3 == 1) {
    lay_small_dish(scene, draws, menus, static_cast<SmallDish>(number / 3 % 4));
    extent_mm = 60.0 + scene.dishes.front().dish.outer_size_mm[0];
  } else {
    lay_tray(scene, draws, menus);
    most_things = 5;
  }
  lay_things(scene, draws, draws.whole(0, most_things));
  draw_training_views(scene, draws, extent_mm);
  draw_training_light(scene, draws);
  draw_exposures(scene, draws);
  draw_dimness(scene, draws);
  draws.shuffle(std::span<LaidFood>(scene.foods));
  return scene;
}

}  // namespace

std::vector<SceneDescription> make_training_scenes(std::uint64_t seed) {
  Draws menu_draws(seed, "training-24 menu");
  Menus menus(menu_draws);
  std::vector<SceneDescription> scenes;
  for (int number = 0; number < kScenes; ++number) {
    Draws draws(seed, "training-24 " + std::to_string(number));
    scenes.push_back(lay_scene(number, draws, menus));
  }
  return scenes;
}

}  // namespace traygauge
