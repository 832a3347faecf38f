#include "simulator/scenes/scene_parts.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "simulator/scenes/dish_shell.hpp"
#include "simulator/scenes/scene_poses.hpp"

namespace traygauge {
namespace {

DishDescription usual_dish(DishStyle style) {
  DishDescription dish;
  switch (style) {
    case DishStyle::dinner:
      dish.style = "dinner";
      dish.outer_size_mm = {260.0, 260.0};
      dish.profile = {{0, 21.4}, {1.6, 22.0}, {4.5, 21.4}, {28, 15.5}, {36, 11.0}, {43, 6.6}, {49, 4.5}};
      break;
    case DishStyle::soup:
      dish.style = "soup";
      dish.outer_size_mm = {230.0, 230.0};
      dish.profile = {{0, 39.4},  {1.6, 40.0}, {4.5, 39.6}, {19, 36.6},
                      {25, 31.5}, {32, 18.5},  {39, 8.6},   {45, 5.5}};
      break;
    case DishStyle::oval:
      dish.style = "oval";
      dish.outer_size_mm = {300.0, 210.0};
      dish.profile = {{0, 23.4}, {1.6, 24.0}, {4.5, 23.5}, {19, 18.6}, {26, 12.4}, {32, 7.0}, {38, 4.0}};
      break;
    case DishStyle::bowl:
      dish.style = "bowl";
      dish.outer_size_mm = {150.0, 150.0};
      dish.profile = {{0, 53.4},  {1.5, 54.2}, {3.0, 53.0}, {8, 39.0}, {14, 27.5},
                      {21, 18.5}, {30, 11.0},  {40, 6.6},   {50, 5.2}};
      break;
    case DishStyle::dessert_bowl:
      dish.style = "dessert_bowl";
      dish.outer_size_mm = {104.0, 104.0};
      dish.profile = {{0, 41.4},  {1.4, 42.0}, {3.0, 41.0}, {6.5, 29.5},
                      {10, 21.5}, {15, 13.5},  {22, 7.6},   {32, 4.4}};
      break;
  }
  return dish;
}

double tenths(double value) {
  return std::round(10.0 * value) / 10.0;
}

// Room for one of several foods on a dish.
struct Slot {
  double x_mm, y_mm, rotation_deg;  // the food's length points along the rotation
  double length_mm, width_mm;
};

std::vector<Slot> slots(DishStyle style, std::size_t count) {
  if (count == 1) return {{0, 0, 0, 140, 115}};
  if (style == DishStyle::oval) {
    if (count == 2) return {{-54, 0, 90, 114, 104}, {54, 0, 90, 114, 104}};
    return {{-74, 0, 90, 106, 72}, {0, 0, 90, 118, 73}, {74, 0, 90, 106, 72}};
  }
  const bool is_deep = style == DishStyle::soup;
  if (count == 2) {
    const double x = is_deep ? 34.0 : 41.0;
    const double length = is_deep ? 112.0 : 130.0;
    const double width = is_deep ? 66.0 : 80.0;
    return {{-x, 0, 90, length, width}, {x, 0, 90, length, width}};
  }
  const double r = is_deep ? 40.0 : 47.0;
  std::vector<Slot> around;
  for (int i = 0; i < 3; ++i) {
    const double angle = radians(90.0 + 120.0 * i);
    around.push_back({r * std::cos(angle), r * std::sin(angle), 180.0 + 120.0 * i, is_deep ? 80.0 : 94.0,
                      is_deep ? 62.0 : 72.0});
  }
  return around;
}

// As large as wanted or as there is room for, stretched by no more than kStretch.
FoodSize portion(Draws& draws, const FoodKind& kind, const Slot& slot, double scale) {
  constexpr double kStretch = 1.3;
  const double wanted = draws.between(0.98, 1.22);
  double length = std::min(wanted, scale * slot.length_mm / kind.size.length_mm);
  double width = std::min(wanted, scale * slot.width_mm / kind.size.width_mm);
  length = std::min(length, kStretch * width);
  width = std::min(width, kStretch * length);
  // A smaller portion is lower, too, but not by as much.
  const double height = std::sqrt(std::min(1.0, std::sqrt(length * width))) * draws.between(0.9, 1.12);
  return {length * kind.size.length_mm, width * kind.size.width_mm, height * kind.size.height_mm};
}

// Lamps as sold (warm white, neutral white, cool daylight), already seen by a camera set to daylight.
const std::array<Eigen::Vector3d, 3> kLightColours = {
    Eigen::Vector3d(1.18, 0.98, 0.74), Eigen::Vector3d(1.04, 1.0, 0.93), Eigen::Vector3d(0.93, 1.0, 1.09)};

Lamp ceiling_lamp(double x_mm, double y_mm, double height_mm, double u_mm, double v_mm,
                  const Eigen::Vector3d& radiance) {
  return {{x_mm, y_mm, height_mm}, {u_mm, 0.0, 0.0}, {0.0, v_mm, 0.0}, radiance};
}

}  // namespace

void scale_dish(DishDescription& dish, double scale) {
  for (double& size : dish.outer_size_mm) size = tenths(scale * size);
  for (ProfilePoint& point : dish.profile)
    point = {tenths(scale * point.inset_mm), tenths(scale * point.height_mm)};
  dish.rim_height_mm = dish.profile[1].height_mm;
  dish.bottom_height_mm = dish.profile.back().height_mm;
}

LaidDish draw_dish(Draws& draws, DishStyle style, double scale, int label) {
  LaidDish laid;
  laid.dish = usual_dish(style);
  scale_dish(laid.dish, scale);
  laid.dish.label = label;
  laid.seed = draws.seed();
  constexpr std::array<std::uint32_t, 5> kWhites = {0xE9E7E2, 0xE4E0D6, 0xDEDDD8, 0xE8E2D2, 0xD8DADA};
  constexpr std::array<std::uint32_t, 4> kPaints = {0x2A3C78, 0x8C2A20, 0x4A6A3A, 0x6A4A2A};
  laid.glaze.srgb = draws.pick(std::span<const std::uint32_t>(kWhites));
  laid.glaze.decoration_srgb = draws.pick(std::span<const std::uint32_t>(kPaints));
  laid.glaze.roughness = static_cast<float>(draws.between(0.06, 0.18));
  const int decoration = draws.whole(0, 4);
  if (decoration == 1) laid.glaze.lines = {{4.0, 2.2}};
  if (decoration == 2)
    laid.glaze.lines = {{3.0, 1.2}, {draws.between(10.0, 18.0), 0.8}, {draws.between(19.0, 21.0), 0.6}};
  if (decoration == 3) laid.glaze.speck_fraction = draws.between(0.1, 0.35);
  return laid;
}

LaidDish ground_under_food(double width_mm, double height_mm, int label) {
  LaidDish ground;
  ground.dish.label = label;
  ground.dish.outer_size_mm = {width_mm, width_mm};
  ground.dish.rim_height_mm = height_mm;
  ground.dish.bottom_height_mm = height_mm;
  ground.is_ground = true;
  return ground;
}

void draw_foods(SceneDescription& scene, Draws& draws, int dish, DishStyle style, double scale,
                std::span<const FoodKind* const> kinds) {
  const std::vector<Slot> places = slots(style, kinds.size());
  const double turn_deg = style == DishStyle::oval ? 180.0 * draws.whole(0, 1) : draws.between(0.0, 360.0);
  const Eigen::Rotation2Dd turn(radians(turn_deg));
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    const Slot& slot = places[i];
    LaidFood food;
    food.kind = kinds[i]->name;
    food.name = food.kind;
    food.dish = dish;
    food.centre_mm = scale * (turn * Eigen::Vector2d(slot.x_mm + draws.between(-3.0, 3.0),
                                                     slot.y_mm + draws.between(-4.0, 4.0)));
    food.rotation_deg = slot.rotation_deg + turn_deg + draws.between(-8.0, 8.0) + 180.0 * draws.whole(0, 1);
    food.size = portion(draws, *kinds[i], slot, scale);
    food.seed = draws.seed();
    scene.foods.push_back(food);
  }
}

void draw_filling(SceneDescription& scene, Draws& draws, int dish, const FoodKind& kind,
                  double level_fraction) {
  const DishDescription& description = scene.dishes[static_cast<std::size_t>(dish)].dish;
  LaidFood food;
  food.kind = kind.name;
  food.name = food.kind;
  food.dish = dish;
  food.rotation_deg = draws.between(0.0, 360.0);
  food.seed = draws.seed();
  food.level_mm = tenths(description.bottom_height_mm +
                         level_fraction * (description.rim_height_mm - description.bottom_height_mm));
  scene.foods.push_back(food);
}

void draw_lamps(SceneDescription& scene, Draws& draws) {
  const Eigen::Vector3d& colour = draws.pick(std::span<const Eigen::Vector3d>(kLightColours));
  const double x = draws.between(-500.0, 500.0);
  const double y = draws.between(-500.0, 500.0);
  const double height = draws.between(1500.0, 2100.0);  // chosen: rooms of 2.3 to 2.9 m, tables of 0.75 m
  double room_fraction = 0.16;  // chosen: what pale walls give back of the lamps' light
  switch (draws.whole(0, 3)) {
    case 0:  // panels of 595 mm, made for ceilings in a grid of 600 mm
      for (int i = 0; i < 4; ++i) {
        const double pitch = 1800.0;
        const int row = i / 2;
        scene.lamps.push_back(ceiling_lamp(x + pitch * (i % 2 - 0.5), y + pitch * (row - 0.5), height, 595.0,
                                           595.0, 10.0 * colour));
      }
      break;
    case 1:  // two rows of tubes, T8 of 58 W: 1500 mm
      for (int i = 0; i < 2; ++i)
        scene.lamps.push_back(ceiling_lamp(x, y + 1500.0 * (i - 0.5), height, 1500.0, 160.0, 22.0 * colour));
      break;
    case 2: {  // a window at the side, and weak light from the ceiling
      const double direction = draws.angle_rad();
      const double c = std::cos(direction);
      const double s = std::sin(direction);
      const double away = draws.between(1100.0, 1800.0);
      scene.lamps.push_back({{away * c, away * s, 900.0},
                             {-1300.0 * s, 1300.0 * c, 0.0},
                             {0.0, 0.0, 1300.0},
                             6.0 * Eigen::Vector3d(0.95, 1.0, 1.06)});
      scene.lamps.push_back(ceiling_lamp(x, y, height, 595.0, 595.0, 7.0 * colour));
      room_fraction = 0.22;
      break;
    }
    default:  // a lamp hung over the table, and others far away
      scene.lamps.push_back(
          ceiling_lamp(0.6 * x, 0.6 * y, draws.between(950.0, 1200.0), 380.0, 380.0, 9.0 * colour));
      scene.lamps.push_back(ceiling_lamp(x + 1500.0, y, height, 595.0, 595.0, 5.0 * colour));
      break;
  }
  set_room(scene, colour, room_fraction * draws.between(0.8, 1.3), 0.85);
}

void set_room(SceneDescription& scene, const Eigen::Vector3d& colour, double fraction, double mended) {
  double irradiance = 0.0;
  for (const Lamp& lamp : scene.lamps) {
    const Eigen::Vector3d normal = lamp.edge_u_mm.cross(lamp.edge_v_mm);
    const Eigen::Vector3d to = lamp.centre_mm;
    irradiance += lamp.radiance.y() * std::abs(normal.dot(to)) * to.z() / std::pow(to.norm(), 4.0);
  }
  scene.ambient = fraction * irradiance / 3.14159 * Eigen::Vector3d(0.5 * (colour + Eigen::Vector3d::Ones()));
  for (Photograph& view : scene.views) {
    view.white_balance = {std::pow(colour.y() / colour.x(), mended),
                          std::pow(colour.y() / colour.z(), mended)};
  }
}

void draw_camera(SceneDescription& scene, Draws& draws, double focal_px) {
  CameraDescription& camera = scene.photography.camera;
  camera.size = {1600, 1200};
  camera.fx_px = tenths(focal_px * draws.between(0.98, 1.02));
  camera.fy_px = camera.fx_px;
  // Chosen: an assembled lens sits within about half a per cent of the width from the sensor's middle.
  camera.cx_px = tenths(799.5 + draws.between(-9.0, 9.0));
  camera.cy_px = tenths(599.5 + draws.between(-9.0, 9.0));
  const auto thousandths = [](double value) { return std::round(1000.0 * value) / 1000.0; };
  // Chosen: barrel distortion of a phone's lens before software straightens it; the second term bends the
  // corners back, as calibrations of such lenses find.
  const double k1 = thousandths(draws.between(-0.11, -0.05));
  camera.distortion = {k1, thousandths(-0.28 * k1), 0.0, 0.0, 0.0};
  // Chosen: what phones save photographs with, by libjpeg's scale.
  scene.photography.jpeg_quality = draws.whole(90, 95);
  // From 3.85 mm at f/2.8 (iPhone 4) to 4.15 mm at f/2.2 (iPhone 6), phones of the paper's years.
  scene.photography.aperture_mm = draws.between(1.4, 1.9);
  // Chosen: what a phone's own shading correction leaves of the 0.56 that cos^4 takes from these corners.
  scene.photography.corner_loss = draws.between(0.1, 0.3);
  // Chosen: the order of what pixels of 1.1 to 1.4 µm hold, and of their noise at a canteen's light.
  scene.photography.full_well_electrons = draws.between(3000.0, 6500.0);
  scene.photography.read_noise_electrons = draws.between(3.0, 6.0);
}

void draw_exposures(SceneDescription& scene, Draws& draws) {
  for (std::size_t i = 0; i < scene.views.size(); ++i) {
    Photograph& view = scene.views[i];
    // Chosen: a phone measures light and white anew for each photograph, and focuses on another place.
    if (i > 0) view.exposure = draws.between(0.88, 1.12);
    for (double& gain : view.white_balance) gain *= draws.between(0.97, 1.03);
    view.focus_error_mm = draws.between(-15.0, 15.0);
  }
}

void draw_card(SceneDescription& scene, Draws& draws) {
  const DishShell shell(scene.dishes.front().dish);
  const Eigen::Isometry3d dish_from_world = world_from_dish(scene.dishes.front()).inverse();
  LaidCard& card = scene.card;
  card.thickness_mm = draws.chance(0.5) ? 0.8 : 0.2;  // plastic (ISO/IEC 7810: 0.76 mm) or cardboard
  card.design = draws.seed();
  for (int tries = 0; tries < 1000; ++tries) {
    // Beside the dish along the picture's width, where there is more room.
    const double direction = draws.between(-0.55, 0.55) + (draws.chance(0.5) ? 3.14159 : 0.0);
    const double away = draws.between(130.0, 240.0);
    card.centre_mm =
        scene.dishes.front().centre_mm + away * Eigen::Vector2d(std::cos(direction), std::sin(direction));
    card.rotation_deg = draws.between(0.0, 360.0);
    const Eigen::Isometry3d world_of_card = world_from_card(card);
    bool is_near = false;
    bool is_free = true;
    for (int i = 0; i <= 8; ++i) {
      for (int k = 0; k <= 8; ++k) {
        const Eigen::Vector3d at =
            dish_from_world *
            (world_of_card * Eigen::Vector3d(card.width_mm * i / 8.0, card.height_mm * k / 8.0, 0.0));
        is_free = is_free && !shell.contains(at.x(), at.y(), -10.0);
        is_near = is_near || shell.contains(at.x(), at.y(), -30.0);
      }
    }
    if (is_free && is_near) return;
  }
  throw std::invalid_argument(scene.name + ": no room for the card");
}

}  // namespace traygauge
