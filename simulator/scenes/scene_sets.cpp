#include "simulator/scenes/scene_sets.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

#include "simulator/scenes/draws.hpp"
#include "simulator/scenes/scene_parts.hpp"
#include "simulator/scenes/scene_views.hpp"

namespace traygauge {
namespace {

constexpr auto kSets = std::to_array<SceneSet>({
    {"meals-45", "45 meals with 113 items, three views each, by hand: the paper's Meals-45"},
    {"angles-13", "13 meals under an arm: a first view and others 5 to 35 degrees from it: Angles-13"},
    {"plates-18", "6 meals on a dinner plate, a soup plate and an oval plate each: Plates-18"},
    {"meals-14", "14 meals with foods and tables that are in no other set: Meals-14"},
    {"trays-8", "8 trays with several dishes and cutlery"},
    {"moved-4", "4 trays, each moved under a still camera"},
});

constexpr double kPhoneFocalPx = 1400.0;  // 60 degrees across: the phones of the paper
constexpr double kWideFocalPx = 1225.0;   // 66 degrees: a whole tray from 60 cm

// Deals foods like cards: each kind comes up once before any comes up again.
class Menu {
 public:
  Menu(Draws& draws, std::initializer_list<FoodGroup> groups, bool is_filled) : draws_(draws) {
    for (const FoodKind& kind : food_kinds()) {
      if (kind.is_filled == is_filled && std::find(groups.begin(), groups.end(), kind.group) != groups.end()) kinds_.push_back(&kind);
    }
    next_ = kinds_.size();
  }

  const FoodKind* deal() {
    if (next_ == kinds_.size()) {
      draws_.shuffle(std::span<const FoodKind*>(kinds_));
      next_ = 0;
    }
    return kinds_[next_++];
  }

  // All different.
  std::vector<const FoodKind*> deal(std::size_t count) {
    std::vector<const FoodKind*> hand;
    while (hand.size() < count) {
      const FoodKind* kind = deal();
      if (std::find(hand.begin(), hand.end(), kind) == hand.end()) hand.push_back(kind);
    }
    return hand;
  }

 private:
  Draws& draws_;
  std::vector<const FoodKind*> kinds_;
  std::size_t next_ = 0;
};

std::string numbered(const char* letter, std::size_t number) {
  return std::string(letter) + (number < 10 ? "0" : "") + std::to_string(number);
}

SceneDescription empty_scene(const std::string& name, Draws& draws) {
  SceneDescription scene;
  scene.name = name;
  scene.seed = draws.seed();
  return scene;
}

void draw_table(SceneDescription& scene, Draws& draws, std::span<const SurfaceKind> kinds) {
  scene.table = {draws.pick(kinds), draws.between(0.0, 180.0), draws.seed()};
}

// Light, and what the camera makes of it, once the views are known.
void finish(SceneDescription& scene, Draws& draws) {
  draw_lamps(scene, draws);
  draw_exposures(scene, draws);
}

constexpr std::array kTables = {SurfaceKind::wood, SurfaceKind::laminate, SurfaceKind::cloth, SurfaceKind::plastic};
constexpr std::array kOtherTables = {SurfaceKind::granite, SurfaceKind::checked_cloth, SurfaceKind::cork, SurfaceKind::steel};
constexpr std::array kPlates = {DishStyle::dinner, DishStyle::soup, DishStyle::oval};

// One dish with foods on it, the table and the card; no views yet.
SceneDescription lay_meal(const std::string& name, Draws draws, DishStyle style, double scale,
                          std::span<const FoodKind* const> kinds, std::span<const SurfaceKind> tables) {
  SceneDescription scene = empty_scene(name, draws);
  draw_camera(scene, draws, kPhoneFocalPx);
  scene.dishes.push_back(draw_dish(draws, style, scale, 1));
  draw_foods(scene, draws, 0, style, scale, kinds);
  draw_table(scene, draws, tables);
  draw_card(scene, draws);
  return scene;
}

std::vector<SceneDescription> make_meals(std::uint64_t seed) {
  constexpr std::size_t kMeals = 45;
  constexpr std::size_t kWithThree = 23;
  Draws menu_draws(seed, "meals-45 menu");
  Menu menu(menu_draws, {FoodGroup::canteen, FoodGroup::fast_food}, false);
  Menu stews(menu_draws, {FoodGroup::canteen}, true);
  std::vector<SceneDescription> scenes;
  for (std::size_t i = 0; i < kMeals; ++i) {
    const std::string name = numbered("m", i + 1);
    Draws draws(seed, "meals-45 " + name);
    const std::size_t count = (i * kWithThree) / kMeals != ((i + 1) * kWithThree) / kMeals ? 3 : 2;
    const DishStyle style = kPlates[(i * 2 + i / 3) % kPlates.size()];
    const auto kinds = menu.deal(count);
    SceneDescription scene = lay_meal(name, draws, style, draws.between(0.96, 1.05), kinds, kTables);
    draw_views(scene, draws, 3, {});
    finish(scene, draws);
    scenes.push_back(std::move(scene));
  }
  return scenes;
}

std::vector<SceneDescription> make_angles(std::uint64_t seed) {
  Draws menu_draws(seed, "angles-13 menu");
  Menu menu(menu_draws, {FoodGroup::canteen, FoodGroup::fast_food}, false);
  std::vector<SceneDescription> scenes;
  for (std::size_t i = 0; i < 13; ++i) {
    const std::string name = numbered("a", i + 1);
    Draws draws(seed, "angles-13 " + name);
    const auto kinds = menu.deal(2 + i % 2);
    SceneDescription scene = lay_meal(name, draws, kPlates[i % 2 == 0 ? 0 : 2], 1.0, kinds, kTables);
    draw_arm_views(scene, draws, 500.0);
    finish(scene, draws);
    scenes.push_back(std::move(scene));
  }
  return scenes;
}

std::vector<SceneDescription> make_plates(std::uint64_t seed) {
  Draws menu_draws(seed, "plates-18 menu");
  Menu menu(menu_draws, {FoodGroup::fast_food}, false);
  std::vector<SceneDescription> scenes;
  for (std::size_t meal = 0; meal < 6; ++meal) {
    const auto kinds = menu.deal(2);
    SceneDescription first;
    for (const DishStyle style : {DishStyle::soup, DishStyle::dinner, DishStyle::oval}) {
      const std::string plate = style == DishStyle::soup ? "soup" : style == DishStyle::dinner ? "dinner" : "oval";
      const std::string name = numbered("c", meal + 1) + "_" + plate;
      Draws draws(seed, "plates-18 " + name);
      SceneDescription scene = lay_meal(name, draws, style, 1.0, kinds, kTables);
      // The same portions on each plate: those that fit the smallest.
      if (style == DishStyle::soup) first = scene;
      for (std::size_t i = 0; i < scene.foods.size(); ++i) {
        scene.foods[i].size = first.foods[i].size;
        scene.foods[i].seed = first.foods[i].seed;
      }
      draw_views(scene, draws, 3, {});
      finish(scene, draws);
      scenes.push_back(std::move(scene));
    }
  }
  return scenes;
}

std::vector<SceneDescription> make_other_meals(std::uint64_t seed) {
  Draws menu_draws(seed, "meals-14 menu");
  Menu menu(menu_draws, {FoodGroup::other}, false);
  std::vector<SceneDescription> scenes;
  for (std::size_t i = 0; i < 14; ++i) {
    const std::string name = numbered("n", i + 1);
    Draws draws(seed, "meals-14 " + name);
    const auto kinds = menu.deal(2 + (i % 3) / 2);
    SceneDescription scene = lay_meal(name, draws, kPlates[i % 3], draws.between(0.92, 1.08), kinds, kOtherTables);
    draw_views(scene, draws, 3, {});
    finish(scene, draws);
    scenes.push_back(std::move(scene));
  }
  return scenes;
}

// A plate with a meal, a bowl with soup and, on the larger tray, a dessert; card, cutlery and napkin where there is room.
SceneDescription lay_tray(const std::string& name, Draws draws, bool has_three, std::span<const FoodKind* const> meal,
                          const FoodKind& soup, const FoodKind& dessert) {
  SceneDescription scene = empty_scene(name, draws);
  draw_camera(scene, draws, kWideFocalPx);
  constexpr std::array kTops = {SurfaceKind::plastic, SurfaceKind::wood, SurfaceKind::laminate};
  scene.tray = Tray{{has_three ? 520.0 : 470.0, 360.0}, draws.pick(std::span<const SurfaceKind>(kTops)), draws.seed()};
  draw_table(scene, draws, kTables);
  const DishStyle plate = draws.chance(0.5) ? DishStyle::oval : DishStyle::dinner;
  const DishStyle deep = has_three && draws.chance(0.5) ? DishStyle::soup : DishStyle::bowl;
  const double half_x = 0.5 * scene.tray->size_mm[0];
  LaidDish main_dish = draw_dish(draws, plate, 1.0, 1);
  main_dish.centre_mm = {plate == DishStyle::oval ? 165.0 - half_x : 145.0 - half_x, plate == DishStyle::oval ? -48.0 : -28.0};
  main_dish.rotation_deg = plate == DishStyle::oval ? draws.between(-5.0, 5.0) : 0.0;
  LaidDish soup_dish = draw_dish(draws, deep, 1.0, 201);
  soup_dish.centre_mm = deep == DishStyle::soup ? Eigen::Vector2d(half_x - 128.0, 48.0) : Eigen::Vector2d(half_x - 97.0, 78.0);
  scene.dishes = {main_dish, soup_dish};
  draw_foods(scene, draws, 0, plate, 1.0, meal);
  draw_filling(scene, draws, 1, soup, deep == DishStyle::soup ? draws.between(0.55, 0.7) : draws.between(0.6, 0.78));
  if (has_three) {
    LaidDish cup = draw_dish(draws, DishStyle::dessert_bowl, 1.0, 202);
    cup.centre_mm = {plate == DishStyle::oval ? 30.0 - 0.1 * half_x : 0.1 * half_x - 8.0, deep == DishStyle::soup && plate == DishStyle::dinner ? -110.0 : 112.0};
    if (deep == DishStyle::bowl) cup.centre_mm = {35.0, 108.0};
    scene.dishes.push_back(cup);
    draw_filling(scene, draws, 2, dessert, draws.between(0.55, 0.8));
  }
  return scene;
}

}  // namespace

std::span<const SceneSet> scene_sets() {
  return kSets;
}

std::vector<SceneDescription> make_scenes(std::string_view set, std::uint64_t seed, bool is_reduced) {
  (void)is_reduced; (void)lay_tray;
  if (set == "meals-45") return make_meals(seed);
  if (set == "angles-13") return make_angles(seed);
  if (set == "plates-18") return make_plates(seed);
  if (set == "meals-14") return make_other_meals(seed);
  throw std::invalid_argument("no set is called " + std::string(set));
}

}  // namespace traygauge
