#include "simulator/scenes/training_dishes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "simulator/scenes/dish_shell.hpp"
#include "simulator/scenes/scene_parts.hpp"

namespace traygauge {
namespace {

DishDescription usual_dish(SmallDish kind) {
  DishDescription dish;
  switch (kind) {
    case SmallDish::side_plate:
      dish.style = "side_plate";
      dish.outer_size_mm = {180.0, 180.0};
      dish.profile = {{0, 17.4}, {1.4, 18.0}, {4, 17.5}, {17, 13.6}, {23, 9.4}, {28, 5.8}, {33, 4.0}};
      break;
    case SmallDish::dessert_plate:  // without a flange
      dish.style = "dessert_plate";
      dish.outer_size_mm = {196.0, 196.0};
      dish.profile = {{0, 21.4}, {1.4, 22.0}, {3, 21.2}, {8, 15.0}, {15, 9.0}, {24, 5.4}, {32, 4.2}};
      break;
    case SmallDish::salad_bowl:
      dish.style = "salad_bowl";
      dish.outer_size_mm = {164.0, 164.0};
      dish.profile = {{0, 59.4},  {1.2, 60.0}, {2.4, 58.6}, {7, 43.0},
                      {14, 28.0}, {24, 15.0},  {36, 7.4},   {48, 4.2}};
      break;
    case SmallDish::ramekin:
      dish.style = "ramekin";
      dish.outer_size_mm = {96.0, 96.0};
      dish.profile = {{0, 43.4}, {1.2, 44.0}, {3, 43.0}, {4.5, 30.0}, {6, 14.0}, {9, 6.4}, {14, 4.6}};
      break;
  }
  return dish;
}

std::uint32_t any_colour(Draws& draws) {
  constexpr std::array<std::uint32_t, 16> kGlazes = {
      0xC8923A, 0xB07A2C, 0x1E1E20, 0x2E3034, 0x2F5C8C, 0x20407A, 0x9DB8CC, 0x5E7E5A,
      0x8A8C8E, 0xB25E38, 0xD8C6A4, 0xC9B08A, 0x7A3030, 0x3E7C80, 0xD9A8A0, 0x5A4634};
  return draws.pick(std::span<const std::uint32_t>(kGlazes));
}

}  // namespace

void draw_training_glaze(Draws& draws, Glaze& glaze) {
  glaze = Glaze();
  constexpr std::array<std::uint32_t, 5> kWhites = {0xF1F0EC, 0xE9E7E2, 0xEDE8DC, 0xE4E6E8, 0xDCDAD4};
  glaze.srgb = draws.chance(0.5) ? draws.pick(std::span<const std::uint32_t>(kWhites)) : any_colour(draws);
  glaze.decoration_srgb =
      draws.chance(0.3) ? draws.pick(std::span<const std::uint32_t>(kWhites)) : any_colour(draws);
  glaze.roughness =
      static_cast<float>(draws.chance(0.25) ? draws.between(0.3, 0.5) : draws.between(0.05, 0.2));
  switch (draws.whole(0, 7)) {
    case 0:  // a coloured edge
      glaze.lines = {{1.0, draws.between(2.0, 7.0)}};
      break;
    case 1: {  // a band around
      const double width_mm = draws.between(6.0, 16.0);
      glaze.lines = {{0.5 * width_mm + draws.between(1.0, 4.0), width_mm}};
      break;
    }
    case 2:
      glaze.lines = {{3.0, 1.0}, {draws.between(6.0, 9.0), 0.8}, {draws.between(12.0, 15.0), 1.6}};
      break;
    case 3:
      glaze.speck_fraction = draws.between(0.2, 0.8);
      break;
    case 4:
      glaze.pattern = GlazePattern::dots;
      break;
    case 5:
      glaze.pattern = GlazePattern::rays;
      break;
    case 6:
      glaze.pattern = GlazePattern::clouds;
      break;
    default:
      break;
  }
}

LaidDish draw_small_dish(Draws& draws, SmallDish kind, int label) {
  LaidDish laid;
  laid.dish = usual_dish(kind);
  laid.dish.label = label;
  laid.seed = draws.seed();
  scale_dish(laid.dish, draws.between(0.88, 1.15));
  draw_training_glaze(draws, laid.glaze);
  if (kind != SmallDish::salad_bowl) return laid;
  const double material = draws.between(0.0, 1.0);
  if (material < 0.4) {
    laid.glaze = Glaze();
    laid.glaze.finish = GlazeFinish::clear;
    laid.glaze.srgb = 0xF9FCFA;  // of the light that meets one surface, what passes
  } else if (material < 0.65) {
    laid.glaze = Glaze();
    laid.glaze.finish = GlazeFinish::metal;
    laid.glaze.srgb = 0xD2D2D0;
    laid.glaze.roughness = static_cast<float>(draws.between(0.12, 0.4));
  }
  return laid;
}

void draw_middle_food(SceneDescription& scene, Draws& draws, int dish, const FoodKind& kind) {
  const DishShell shell(scene.dishes[static_cast<std::size_t>(dish)].dish);
  // Up the wall of a bowl, but not on a plate's flange.
  const bool is_bowl = shell.rim_height_mm() > 0.5 * shell.semi_axis_mm(0);
  const double reach_mm =
      is_bowl ? 0.8 * shell.semi_axis_mm(0) : shell.semi_axis_mm(0) - shell.flat_inset_mm() + 4.0;
  const double most_mm = std::max(kind.size.length_mm, kind.size.width_mm);
  // A heap takes the bowl's shape: as wide as there is room.
  const double stretch = std::min(draws.between(0.9, 1.2) * (is_bowl ? 1.6 : 1.0), 2.0 * reach_mm / most_mm);
  LaidFood food;
  food.kind = kind.name;
  food.name = food.kind;
  food.dish = dish;
  const double play_mm = is_bowl ? 2.0 : std::max(0.0, reach_mm - 0.5 * stretch * most_mm);
  food.centre_mm = {draws.between(-0.6, 0.6) * play_mm, draws.between(-0.6, 0.6) * play_mm};
  food.rotation_deg = draws.between(0.0, 360.0);
  const double lower = std::sqrt(std::min(1.0, stretch)) * draws.between(0.9, 1.1);
  food.size = {stretch * kind.size.length_mm, stretch * (is_bowl ? most_mm : kind.size.width_mm),
               lower * kind.size.height_mm};
  food.seed = draws.seed();
  scene.foods.push_back(food);
}

}  // namespace traygauge
