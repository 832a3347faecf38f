#include "simulator/scenes/scene_views.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <vector>

#include "simulator/render/lens.hpp"
#include "simulator/scenes/dish_shell.hpp"
#include "simulator/scenes/scene_poses.hpp"

namespace traygauge {
namespace {

constexpr int kViewTries = 20000;
constexpr double kClearanceMm = 2.0;    // between a rim and the lines of sight to the card
constexpr double kBorderShare = 0.012;  // of the picture's width: how far from its border everything is

// Rims and card corners in the world.
std::vector<Eigen::Vector3d> outline_of(const SceneDescription& scene) {
  constexpr int kAround = 32;
  std::vector<Eigen::Vector3d> points;
  for (const LaidDish& dish : scene.dishes) {
    const Eigen::Isometry3d pose = world_from_dish(dish);
    for (int i = 0; i < kAround; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kAround;
      points.emplace_back(pose * Eigen::Vector3d(0.5 * dish.dish.outer_size_mm[0] * std::cos(angle),
                                                 0.5 * dish.dish.outer_size_mm[1] * std::sin(angle),
                                                 dish.dish.rim_height_mm));
    }
  }
  const Eigen::Isometry3d card = world_from_card(scene.card);
  for (int i = 0; i < 4; ++i) {
    points.emplace_back(card * Eigen::Vector3d(i % 2 == 0 ? 0.0 : scene.card.width_mm,
                                               i < 2 ? 0.0 : scene.card.height_mm, 0.0));
  }
  return points;
}

Eigen::Vector3d middle_of(const SceneDescription& scene) {
  const LaidDish& dish = scene.dishes.front();
  return {dish.centre_mm.x(), dish.centre_mm.y(), dish.dish.bottom_height_mm};
}

// The middle of what has to be in the picture.
Eigen::Vector3d target_of(const SceneDescription& scene) {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(1e9);
  Eigen::Vector3d high = -low;
  for (const Eigen::Vector3d& point : outline_of(scene)) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  const Eigen::Vector3d middle = 0.5 * (low + high);
  return {middle.x(), middle.y(), 0.0};
}

bool shows_all(const SceneDescription& scene, const Photograph& view) {
  return is_all_in_picture(scene, view) && !is_card_hidden(scene, view);
}

std::optional<Photograph> draw_view(const SceneDescription& scene, Draws& draws, const ViewLimits& limits,
                                    const Eigen::Vector3d& target_mm) {
  Photograph view;
  view.target_mm = target_mm + Eigen::Vector3d(draws.between(-15.0, 15.0), draws.between(-10.0, 10.0), 0.0);
  view.distance_mm = draws.between(limits.nearest_mm, limits.farthest_mm);
  view.tilt_deg = draws.between(2.0, limits.steepest_tilt_deg);
  view.azimuth_deg = draws.between(0.0, 360.0);
  view.roll_deg = draws.between(-8.0, 8.0);
  if (!shows_all(scene, view)) return std::nullopt;
  return view;
}

}  // namespace

bool is_card_hidden(const SceneDescription& scene, const Photograph& view) {
  const Eigen::Vector3d pupil = camera_from_world(view).inverse().translation();
  const Eigen::Isometry3d world_of_card = world_from_card(scene.card);
  constexpr int kSteps = 6;
  for (const LaidDish& dish : scene.dishes) {
    const DishShell shell(dish.dish);
    const Eigen::Isometry3d dish_from_world = world_from_dish(dish).inverse();
    for (int i = 0; i < 4 * kSteps; ++i) {
      // Around the card's border.
      const double along = static_cast<double>(i % kSteps) / kSteps;
      const std::array<Eigen::Vector2d, 4> sides = {Eigen::Vector2d(along, 0.0), Eigen::Vector2d(1.0, along),
                                                    Eigen::Vector2d(1.0 - along, 1.0),
                                                    Eigen::Vector2d(0.0, 1.0 - along)};
      const Eigen::Vector2d& share = sides[static_cast<std::size_t>(i / kSteps)];
      const Eigen::Vector3d at = world_of_card * Eigen::Vector3d(share.x() * scene.card.width_mm,
                                                                 share.y() * scene.card.height_mm, 0.0);
      for (const double height_mm : {0.5 * dish.dish.rim_height_mm, dish.dish.rim_height_mm}) {
        const Eigen::Vector3d passed =
            dish_from_world * (at + (height_mm - at.z()) / (pupil.z() - at.z()) * (pupil - at));
        if (shell.contains(passed.x(), passed.y(), -kClearanceMm)) return true;
      }
    }
  }
  return false;
}

bool is_all_in_picture(const SceneDescription& scene, const Photograph& view) {
  const ViewCamera camera = view_camera(scene, view);
  const Lens lens(camera);
  const Eigen::Isometry3d pose = camera_from_world(view);
  const double border = kBorderShare * camera.width;
  const std::vector<Eigen::Vector3d> points = outline_of(scene);
  return std::all_of(points.begin(), points.end(), [&](const Eigen::Vector3d& point) {
    const Eigen::Vector3d at = pose * point;
    if (at.z() <= 1.0) return false;
    const Eigen::Vector2d pixel = lens.pixel_of(at.head<2>() / at.z());
    return pixel.x() > border && pixel.y() > border && pixel.x() < camera.width - border &&
           pixel.y() < camera.height - border;
  });
}

void draw_views(SceneDescription& scene, Draws& draws, int count, const ViewLimits& limits) {
  const Eigen::Vector3d target_mm = target_of(scene);
  const Eigen::Vector3d middle = middle_of(scene);
  std::vector<Photograph> views;
  for (int tries = 0; tries < kViewTries && views.size() < static_cast<std::size_t>(count); ++tries) {
    if (tries % 500 == 499) views.clear();  // a first view that allows no others
    const std::optional<Photograph> view = draw_view(scene, draws, limits, target_mm);
    if (!view) continue;
    const auto suits = [&](const Photograph& other) {
      const double angle_deg =
          relative_angle_deg(view_camera(scene, *view), view_camera(scene, other), middle);
      return angle_deg >= limits.least_angle_deg && angle_deg <= limits.largest_angle_deg;
    };
    if (std::all_of(views.begin(), views.end(), suits)) views.push_back(*view);
  }
  if (views.size() < static_cast<std::size_t>(count))
    throw std::invalid_argument(scene.name + ": no views found");
  scene.views = views;
  for (int i = 0; i < count; ++i) {
    for (int k = i + 1; k < count; ++k) scene.pairs.push_back({i, k});
  }
}

void draw_arm_views(SceneDescription& scene, Draws& draws, double distance_mm, int steps) {
  constexpr double kStepDeg = 5.0;
  const Eigen::Vector3d target_mm = target_of(scene);
  for (int tries = 0; tries < kViewTries; ++tries) {
    const double start_deg = draws.between(-25.0, -10.0);
    const int sense = draws.chance(0.5) ? 1 : -1;
    scene.views.clear();
    for (int i = 0; i <= steps; ++i) {
      const double arm = radians(sense * (start_deg + kStepDeg * i));
      const Eigen::Vector3d middle = middle_of(scene);
      const Eigen::Vector3d out = Eigen::AngleAxisd(arm, Eigen::Vector3d::UnitX()) * Eigen::Vector3d::UnitZ();
      Photograph view;
      view.target_mm = {target_mm.x(), middle.y(), middle.z()};
      const Eigen::Vector3d offset = middle + distance_mm * out - view.target_mm;
      const Eigen::Vector3d back = offset.normalized();
      view.distance_mm = offset.norm();
      view.tilt_deg = std::acos(back.z()) * 180.0 / std::numbers::pi;
      view.azimuth_deg = std::atan2(back.y(), back.x()) * 180.0 / std::numbers::pi;
      view.arm_angle_deg = kStepDeg * (sense * i);
      scene.views.push_back(view);
    }
    const auto is_seen = [&](const Photograph& view) { return shows_all(scene, view); };
    if (!std::all_of(scene.views.begin(), scene.views.end(), is_seen)) continue;
    for (int i = 1; i <= steps; ++i) scene.pairs.push_back({0, i});
    return;
  }
  throw std::invalid_argument(scene.name + ": no views found");
}

void draw_moved_views(SceneDescription& scene, Draws& draws, const ViewLimits& limits) {
  const Eigen::Vector3d target_mm = target_of(scene);
  const Eigen::Vector3d middle = middle_of(scene);
  for (int tries = 0; tries < kViewTries; ++tries) {
    const std::optional<Photograph> first = draw_view(scene, draws, limits, target_mm);
    if (!first) continue;
    Photograph second = *first;
    second.tray_shift_mm = {draws.between(-25.0, 25.0), draws.between(-25.0, 25.0)};
    second.tray_turn_deg = draws.between(12.0, 40.0) * (draws.chance(0.5) ? 1.0 : -1.0);
    if (!shows_all(scene, second)) continue;
    const double angle_deg =
        relative_angle_deg(view_camera(scene, *first), view_camera(scene, second), middle);
    if (angle_deg < limits.least_angle_deg || angle_deg > limits.largest_angle_deg) continue;
    scene.views = {*first, second};
    scene.pairs = {{0, 1}};
    return;
  }
  throw std::invalid_argument(scene.name + ": no views found");
}

void add_slips(SceneDescription& scene, Draws& draws) {
  constexpr std::array kLengthsMm = {0.5, 1.0, 2.0, 4.0, 8.0, 15.0};
  constexpr double kSpreadDeg = 60.0;  // to either side of straight away
  constexpr double kLeverMm = 60.0;    // a slip turns what slips: its length over this, at most
  const LaidDish& dish = scene.dishes.front();
  const Eigen::Vector2d from_card = dish.centre_mm - scene.card.centre_mm;
  const Photograph second = scene.views.at(1);
  const auto add = [&](std::uint8_t label, double length_mm, const Eigen::Vector2d& away) {
    const Eigen::Rotation2Dd aside(radians(draws.between(-kSpreadDeg, kSpreadDeg)));
    const double turn_deg = draws.between(-1.0, 1.0) * length_mm / kLeverMm / radians(1.0);
    Photograph view = second;
    view.displaced = {{label, length_mm * (aside * away.normalized()), turn_deg}};
    scene.pairs.push_back({0, static_cast<int>(scene.views.size())});
    scene.views.push_back(view);
  };
  const auto food = std::find_if(scene.foods.begin(), scene.foods.end(),
                                 [](const LaidFood& laid) { return laid.dish == 0 && laid.level_mm == 0.0; });
  const auto food_label = static_cast<std::uint8_t>(kFirstItemLabel + (food - scene.foods.begin()));
  scene.pairs = {{0, 1}};
  for (const double length_mm : kLengthsMm) {
    add(kCardLabel, length_mm, -from_card);
    add(static_cast<std::uint8_t>(dish.dish.label), length_mm, from_card);
    if (food != scene.foods.end())
      add(food_label, length_mm, Eigen::Vector2d(draws.between(-1.0, 1.0), draws.between(-1.0, 1.0)));
  }
}

void keep_first_pairs(SceneDescription& scene, std::size_t count) {
  if (scene.pairs.size() <= count) return;
  scene.pairs.resize(count);
  int last = 0;
  for (const auto& [a, b] : scene.pairs) last = std::max({last, a, b});
  scene.views.resize(static_cast<std::size_t>(last) + 1);
}

}  // namespace traygauge
