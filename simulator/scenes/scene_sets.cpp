#include "simulator/scenes/scene_sets.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

#include "simulator/scenes/beside_set.hpp"
#include "simulator/scenes/draws.hpp"
#include "simulator/scenes/scene_menu.hpp"
#include "simulator/scenes/scene_parts.hpp"
#include "simulator/scenes/scene_series.hpp"
#include "simulator/scenes/scene_views.hpp"
#include "simulator/scenes/training_set.hpp"
#include "simulator/scenes/tray_sets.hpp"

namespace traygauge {
namespace {

constexpr auto kSets = std::to_array<SceneSet>({
    {"meals-45", "45 meals with 113 items, three views each, by hand: the paper's Meals-45"},
    {"angles-13", "13 meals under an arm: a first view and others 5 to 35 degrees from it: Angles-13"},
    {"plates-18", "6 meals on a dinner plate, a soup plate and an oval plate each: Plates-18"},
    {"meals-14", "14 meals with foods and tables that are in no other set: Meals-14"},
    {"trays-8", "8 trays with several dishes and cutlery"},
    {"beside-8", "8 trays with a plate, and food beside it on the tray or on a napkin"},
    {"moved-4", "4 trays, each moved under a still camera"},
    {"slips-10", "10 meals and trays whose card, dish or food slips by 0.5 to 15 mm between two pictures"},
    {"cards-8", "8 meals whose card leans by 0.5 to 4 degrees, or is bent up by 1 to 8 mm at one edge"},
    {"station-40", "40 trays at one station: other food on the same dishes, seen from the same two places"},
    {"training-24",
     "24 meals, small dishes and trays, four views each, to train on: pale foods, colours, hands, cups"},
});

constexpr std::array kOtherTables = {SurfaceKind::granite, SurfaceKind::checked_cloth, SurfaceKind::cork,
                                     SurfaceKind::steel};
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
  Menu menu(menu_draws, {FoodGroup::canteen, FoodGroup::fast_food}, FoodServing::solid);
  return make_each(kMeals, "m", "meals-45", seed, [&](std::size_t i, const std::string& name, Draws& draws) {
    const std::size_t count = (i * kWithThree) / kMeals != ((i + 1) * kWithThree) / kMeals ? 3 : 2;
    const DishStyle style = kPlates[(i * 2 + i / 3) % kPlates.size()];
    const auto kinds = menu.deal(count);
    SceneDescription scene = lay_meal(name, draws, style, draws.between(0.96, 1.05), kinds, kTables);
    draw_views(scene, draws, 3, {});
    return scene;
  });
}

std::vector<SceneDescription> make_angles(std::uint64_t seed) {
  Draws menu_draws(seed, "angles-13 menu");
  Menu menu(menu_draws, {FoodGroup::canteen, FoodGroup::fast_food}, FoodServing::solid);
  return make_each(13, "a", "angles-13", seed, [&](std::size_t i, const std::string& name, Draws& draws) {
    const auto kinds = menu.deal(2 + i % 2);
    SceneDescription scene = lay_meal(name, draws, kPlates[i % 2 == 0 ? 0 : 2], 1.0, kinds, kTables);
    draw_arm_views(scene, draws, 500.0, 7);
    return scene;
  });
}

std::vector<SceneDescription> make_plates(std::uint64_t seed) {
  Draws menu_draws(seed, "plates-18 menu");
  Menu menu(menu_draws, {FoodGroup::fast_food}, FoodServing::solid);
  std::vector<SceneDescription> scenes;
  for (std::size_t meal = 0; meal < 6; ++meal) {
    const auto kinds = menu.deal(2);
    SceneDescription first;
    for (const DishStyle style : {DishStyle::soup, DishStyle::dinner, DishStyle::oval}) {
      const std::string plate = style == DishStyle::soup     ? "soup"
                                : style == DishStyle::dinner ? "dinner"
                                                             : "oval";
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
  Menu menu(menu_draws, {FoodGroup::other}, FoodServing::solid);
  return make_each(14, "n", "meals-14", seed, [&](std::size_t i, const std::string& name, Draws& draws) {
    const auto kinds = menu.deal(2 + (i % 3) / 2);
    SceneDescription scene =
        lay_meal(name, draws, kPlates[i % 3], draws.between(0.92, 1.08), kinds, kOtherTables);
    draw_views(scene, draws, 3, {});
    return scene;
  });
}

// Every fourth is a tray.
std::vector<SceneDescription> make_slips(std::uint64_t seed) {
  Draws menu_draws(seed, "slips-10 menu");
  Menu menu(menu_draws, {FoodGroup::canteen, FoodGroup::fast_food}, FoodServing::solid);
  Menu soups(menu_draws, {FoodGroup::canteen}, FoodServing::soup);
  Menu desserts(menu_draws, {FoodGroup::canteen}, FoodServing::dessert);
  const auto lay = [&](std::size_t i, const std::string& name, Draws& draws) {
    const auto kinds = menu.deal(2 + i % 2);
    const bool is_tray = i % 4 == 3;
    SceneDescription scene = is_tray ? lay_tray(name, draws, false, kinds, soups, desserts)
                                     : lay_meal(name, draws, kPlates[i % 3], 1.0, kinds, kTables);
    draw_views(scene, draws, 2, is_tray ? kTrayViews : ViewLimits());
    return scene;
  };
  std::vector<SceneDescription> scenes = make_each(10, "s", "slips-10", seed, lay);
  for (SceneDescription& scene : scenes) {
    Draws draws(seed, "slips-10 slips of " + scene.name);
    add_slips(scene, draws);
  }
  return scenes;
}

std::vector<SceneDescription> make_spoilt_cards(std::uint64_t seed) {
  Draws menu_draws(seed, "cards-8 menu");
  Menu menu(menu_draws, {FoodGroup::canteen, FoodGroup::fast_food}, FoodServing::solid);
  constexpr std::array kTiltsDeg = {0.5, 1.0, 2.0, 4.0};
  constexpr std::array kCurlsMm = {1.0, 2.0, 4.0, 8.0};
  return make_each(8, "c", "cards-8", seed, [&](std::size_t i, const std::string& name, Draws& draws) {
    SceneDescription scene = lay_meal(name, draws, kPlates[i % 3], 1.0, menu.deal(2), kTables);
    if (i < kTiltsDeg.size())
      scene.card.tilt_deg = kTiltsDeg[i];
    else
      scene.card.curl_mm = kCurlsMm[i - kTiltsDeg.size()];
    draw_views(scene, draws, 2, {});
    return scene;
  });
}

// One pixel for a square of `factor` x `factor`.
void shrink(CameraDescription& camera, int factor) {
  const double scale = 1.0 / factor;
  camera.size = {camera.size.width / factor, camera.size.height / factor};
  camera.fx_px *= scale;
  camera.fy_px *= scale;
  camera.cx_px = scale * (camera.cx_px + 0.5) - 0.5;
  camera.cy_px = scale * (camera.cy_px + 0.5) - 0.5;
}

// The first scenes, spread over what varies in the set.
void reduce(std::vector<SceneDescription>& scenes, std::size_t count) {
  scenes.resize(std::min(count, scenes.size()));
  for (SceneDescription& scene : scenes) shrink(scene.photography.camera, 2);
}

// The small picture is to look like a large one that was reduced: a pixel holds the electrons of all that it
// stands for, and what compression does to the large one hardly shows.
void make_quick(SceneDescription& scene) {
  constexpr int kFactor = 5;
  PhotographySettings& photography = scene.photography;
  shrink(photography.camera, kFactor);
  photography.full_well_electrons *= kFactor * kFactor;
  photography.read_noise_electrons *= kFactor;
  photography.jpeg_quality = 98;
  scene.food_step_mm = 0.6;  // pixels show 1.5 mm and more
}

constexpr std::string_view size_note(SetSize size) {
  switch (size) {
    case SetSize::full:
      return "";
    case SetSize::reduced:
      return ", reduced";
    case SetSize::quick:
      return ", quick";
  }
  return "";
}

}  // namespace

std::span<const SceneSet> scene_sets() {
  return kSets;
}

std::vector<SceneDescription> make_scenes(std::string_view set, std::uint64_t seed, SetSize size) {
  std::vector<SceneDescription> scenes;
  std::size_t reduced_count = 1;
  if (set == "meals-45") {
    scenes = make_meals(seed);
    reduced_count = 4;
  } else if (set == "angles-13") {
    scenes = make_angles(seed);
  } else if (set == "plates-18") {
    scenes = make_plates(seed);
    reduced_count = 3;
  } else if (set == "meals-14") {
    scenes = make_other_meals(seed);
    reduced_count = 2;
  } else if (set == "trays-8") {
    scenes = make_trays(seed, "trays-8", "t", 8, false);
  } else if (set == "beside-8") {
    scenes = make_beside(seed);
    reduced_count = 2;
  } else if (set == "moved-4") {
    scenes = make_trays(seed, "moved-4", "v", 4, true);
  } else if (set == "slips-10") {
    scenes = make_slips(seed);
    reduced_count = 10;
  } else if (set == "cards-8") {
    scenes = make_spoilt_cards(seed);
    reduced_count = 8;
  } else if (set == "station-40") {
    scenes = make_station(seed);
    reduced_count = 24;
  } else if (set == "training-24") {
    scenes = make_training_scenes(seed);
    reduced_count = 6;
  } else {
    throw std::invalid_argument("no set is called " + std::string(set));
  }
  if (size == SetSize::reduced) reduce(scenes, reduced_count);
  for (SceneDescription& scene : scenes) {
    if (size == SetSize::quick) make_quick(scene);
    scene.origin = std::string(set) + ", seed " + std::to_string(seed) + std::string(size_note(size));
  }
  return scenes;
}

RenderSettings quick_settings() {
  RenderSettings settings;
  settings.samples = 8;
  settings.edge_samples = 8;
  settings.calm_spread = 0.15F;
  settings.indirect_samples = 2;
  settings.penumbra_samples = 2;
  settings.bounces = 1;
  settings.indirect_filter_px = 4.0F;
  return settings;
}

}  // namespace traygauge
