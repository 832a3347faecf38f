#include "firmware/simulate/plan_scenes.hpp"

#include <cmath>

#include "firmware/base/exit_status.hpp"
#include "firmware/config/config_folder.hpp"
#include "firmware/config/dish_choice.hpp"
#include "firmware/config/dish_library.hpp"
#include "simulator/scenes/draws.hpp"
#include "simulator/scenes/scene_parts.hpp"
#include "simulator/scenes/scene_views.hpp"

namespace traygauge {
namespace {

constexpr double kFocalPx = 1400.0;
constexpr double kDistanceMm = 560.0;
constexpr double kFirstViewDeg = -9.0;  // about the left-right line through the middle of the dish
constexpr double kSecondViewDeg = 9.0;
constexpr double kMiddleOfViewMm = 60.0;  // to the right of the tray's middle, because of the card
// Chosen: how exactly a person lays what a plan asks for.
constexpr double kLaidMm = 3.0;
constexpr double kLaidDeg = 3.0;

Photograph view_at(double arm_deg, double rest_mm) {
  Photograph view;
  view.target_mm = {kMiddleOfViewMm, 0.0, rest_mm};
  view.distance_mm = kDistanceMm;
  view.tilt_deg = std::abs(arm_deg);
  view.azimuth_deg = arm_deg < 0.0 ? 90.0 : -90.0;
  view.arm_angle_deg = arm_deg - kFirstViewDeg;
  return view;
}

DishDescription find_plan_dish(const VerifyPlan& plan, const std::string& config) {
  const auto found = find_dishes({plan.dish}, read_dish_library(find_config_folder(config)));
  if (found.ok()) return found->front();
  throw UsageError("the plan's dish: config/dishes has no style " + printable(plan.dish));
}

// What all scans of a test have in common.
SceneDescription lay_station(const DishDescription& dish, const PlanSceneOptions& options) {
  SceneDescription scene;
  Draws draws(options.seed, "verify station");
  draw_camera(scene, draws, kFocalPx);
  CameraDescription& camera = scene.photography.camera;
  if (options.is_reduced) camera = scaled(camera, {camera.size.width / 2, camera.size.height / 2});
  LaidDish laid;
  laid.dish = dish;
  scene.dishes.push_back(laid);
  scene.table = {SurfaceKind::laminate, 0.0, draws.seed()};
  scene.card.print = options.card_print;
  draw_lamps(scene, draws);
  scene.views = {view_at(kFirstViewDeg, dish.bottom_height_mm),
                 view_at(kSecondViewDeg, dish.bottom_height_mm)};
  scene.pairs = {{0, 1}};
  return scene;
}

}  // namespace

std::vector<SceneDescription> scenes_of_plan(const VerifyPlan& plan, const PlanSceneOptions& options) {
  const SceneDescription station = lay_station(find_plan_dish(plan, options.config), options);
  std::vector<SceneDescription> scenes;
  for (const VerifyStep& step : plan.steps) {
    const VerifyBody& body = plan.bodies[step.body];
    if (body.proof.empty())
      throw UsageError("body " + body.id +
                       ": only folded bodies (proof = …) can be rendered; remove it from the plan");
    Draws draws(options.seed, step.id);
    const auto off_mm = [&] { return draws.between(-kLaidMm, kLaidMm); };
    const auto off_deg = [&] { return draws.between(-kLaidDeg, kLaidDeg); };
    SceneDescription scene = station;
    scene.name = step.id;
    scene.origin = "plan " + plan.name + ", seed " + std::to_string(options.seed);
    scene.seed = draws.seed();
    const auto& shift_mm = plan.places[step.place].shift_mm;
    scene.dishes.front().centre_mm = {shift_mm[0] + off_mm(), shift_mm[1] + off_mm()};
    scene.dishes.front().rotation_deg = off_deg();
    const double reach_mm = 0.5 * scene.dishes.front().dish.outer_size_mm[0];
    scene.card.centre_mm =
        scene.dishes.front().centre_mm + Eigen::Vector2d(reach_mm + 60.0 + off_mm(), off_mm());
    scene.card.rotation_deg = 90.0 + off_deg();
    LaidFood laid;
    laid.name = body.id;
    laid.body = body.proof;
    laid.centre_mm = {off_mm(), off_mm()};
    laid.rotation_deg = step.angle_deg + off_deg() - scene.dishes.front().rotation_deg;
    scene.foods.push_back(laid);
    draw_exposures(scene, draws);
    for (const Photograph& view : scene.views) {
      if (is_all_in_picture(scene, view)) continue;
      throw UsageError("step " + step.id +
                       ": dish and card do not fit into the picture; shift that place less");
    }
    scenes.push_back(std::move(scene));
  }
  return scenes;
}

}  // namespace traygauge
