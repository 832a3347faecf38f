#include "core/pipeline/tray_measurement.hpp"

#include <algorithm>
#include <cmath>

#include "core/pipeline/bare_checks.hpp"
#include "core/pipeline/dish_measurement.hpp"
#include "core/pipeline/dish_observation.hpp"
#include "core/pipeline/standing_object.hpp"
#include "core/pipeline/tray_checks.hpp"
#include "core/pipeline/tray_food.hpp"
#include "core/quality/view_input.hpp"

namespace traygauge {
namespace {

bool works_in_reverse(const TrayMemory& memory) {
  return memory.views[1].regions().dish_pixels > memory.views[0].regions().dish_pixels;
}

CheckedTray in_order(TrayMemory& memory, const Segmentation* found) {
  const bool reversed = works_in_reverse(memory);
  return {{&memory.views[reversed ? 1 : 0], &memory.views[reversed ? 0 : 1]}, reversed, found};
}

// What does not move with the scene is on the lens.
void warn_about_lens(const ViewPair& views, const ViewCheckParams& params, WarningSet& warnings) {
  const ImageView<const std::uint8_t> first = views[0]->gray.levels[0];
  const ImageView<const std::uint8_t> second = views[1]->gray.levels[0];
  if (first.width != second.width || first.height != second.height) return;
  BlankBlockTable blank;
  count_blank_blocks({first, second}, {views[0]->labels, views[1]->labels}, views[0]->regions().dish,
                     params.item_pixels, blank);
  for (std::size_t label = kFirstItemLabel; label < blank.size(); ++label) {
    const ItemPixels& item = views[0]->quality().items[label];
    const bool has_texture_elsewhere =
        item.textured >= params.textured_warning * static_cast<double>(item.blocks - blank[label]);
    if (blank[label] < params.min_blank_blocks || !has_texture_elsewhere) continue;
    // Food that is refused as smooth has little texture anywhere.
    const auto of_item = static_cast<std::uint8_t>(label);
    const StatusCode pixels = judge_item_pixels(of_item, views[0]->quality(), views[1]->quality(), params);
    warnings.raise_if(pixels == StatusCode::ok, Warning::lens_dirty, of_item);
  }
}

// Where the first dish stands, on the table.
Vec3 dish_on_table(const SceneGeometry& geometry) {
  for (std::size_t d = 0; d < geometry.dish_count; ++d) {
    const BundleDishResult& dish = geometry.bundle.dishes[d];
    if (!dish.status.ok()) continue;
    const Vec2& centre = dish.placed.place.centre_mm;
    return {centre.x(), centre.y(), 0.0};
  }
  return Vec3::Zero();
}

// The camera did not move against the card, as far as a card can tell.
bool is_same_place(const SceneGeometry& geometry) {
  return second_from_first(geometry.bundle.camera_from_table).translation.norm() < kNearMm;
}

void report_pose(const SceneGeometry& geometry, bool reversed, Measurement& measurement) {
  const Pose motion = second_from_first(geometry.bundle.camera_from_table);
  measurement.has_pose = true;
  measurement.second_from_first = reversed ? motion.inverse() : motion;
  measurement.rotation_angle_deg = rotation_angle_deg(motion.rotation);
  measurement.relative_angle_deg =
      angle_between_views_deg(geometry.bundle.camera_from_table, dish_on_table(geometry));
  const Pose& reference = geometry.bundle.camera_from_table[0];
  const Vec3 up = reference.rotation.col(2);
  measurement.views.table = {up, up.dot(reference.translation)};
  measurement.views.camera_from_table = geometry.bundle.camera_from_table;
  if (reversed) std::swap(measurement.views.camera_from_table[0], measurement.views.camera_from_table[1]);
}

// What a dish says of the fault that tracks alone cannot name.
Status named(Status status, const SceneGeometry& geometry) {
  for (const DishOnTray& dish : std::span(geometry.dishes).first(geometry.dish_count)) {
    if (!dish.verdict.ok()) return dish.verdict;
  }
  return status;
}

// Measured nevertheless, in the dishes' own frame.
void report_own_motion(const SceneGeometry& geometry, Measurement& measurement) {
  const OwnMotion& motion = geometry.own_motion;
  if (!motion.is_known) return;
  for (const DishOnTray& dish : std::span(geometry.dishes).first(geometry.dish_count)) {
    measurement.checks.add({CheckKind::own_motion_mm, dish.label, motion.shift_mm.norm(),
                            motion.shift_sigma_mm, 0.0, Verdict::warned});
    measurement.warnings.raise(Warning::dish_moved, dish.label);
  }
}

// A dish that was looked for and not found stands somewhere, too.
void warn_about_unknown_objects(const CheckedTray& tray, const SceneGeometry& geometry,
                                const Configuration& configuration, Measurement& measurement) {
  if (tray.found != nullptr && !tray.found->has_all_dishes()) return;
  const StandingObject object =
      find_standing_object(tray.views, geometry, configuration.card.size(), configuration.checks.standing);
  measurement.checks.add({CheckKind::object_height_mm, kBackgroundLabel, object.height_mm, object.sigma_mm,
                          configuration.checks.standing.least_height_mm,
                          object.is_seen ? Verdict::warned : Verdict::passed});
  measurement.warnings.raise_if(object.is_seen, Warning::unknown_object);
}

void warn_about_guessed_dishes(const SceneGeometry& geometry, WarningSet& warnings) {
  for (const DishOnTray& dish : std::span(geometry.dishes).first(geometry.dish_count))
    warnings.raise_if(dish.candidates.size() > 1, Warning::dish_guessed, dish.label);
}

}  // namespace

void locate_tray(TrayMemory& memory, const Configuration& configuration, const Segmentation* found,
                 std::uint64_t seed, StageObserver* observer, StageClock& clock, Measurement& measurement) {
  const CheckedTray checked = in_order(memory, found);
  const ViewPair& views = checked.views;
  const bool reversed = checked.is_reversed;
  measurement.views.reference_view = reversed ? 1 : 0;
  Random random(seed);
  SceneGeometry& geometry = memory.scene.front();
  geometry = {};
  measurement.status =
      compare_pictures(memory.views[0].quality(), memory.views[1].quality(), configuration.view_checks,
                       measurement.report.pictures, measurement.warnings);
  if (!measurement.status.ok()) return;
  measurement.warnings.raise_if(
      std::ranges::any_of(views, [](const TrayView* view) { return view->card().condition.is_doubtful; }),
      Warning::card_partly_hidden);
  warn_about_lens(views, configuration.view_checks, measurement.warnings);
  measurement.status = list_dishes(views, configuration, memory.geometry, geometry);
  if (!measurement.status.ok()) return;
  // Outlines by hand may belong to another picture, which looks like a motion.
  if (found != nullptr) geometry.own_motion = reversed ? found->own_motion.reversed() : found->own_motion;
  if (geometry.own_motion.is_too_far) {
    measurement.status = StatusCode::dish_moved;
    return;
  }
  measurement.status =
      find_geometry(views, configuration, random, memory.geometry, clock, measurement.report, geometry);
  const bool are_cameras_known =
      measurement.status.ok() || measurement.status.code() == StatusCode::pose_contradicts_card;
  if (are_cameras_known) {
    geometry.table = find_table(views, geometry.bundle.camera_from_table, configuration.card.size(),
                                configuration.checks.bare);
    check_dishes(checked, memory.geometry, configuration, geometry, measurement.checks, measurement.warnings);
  }
  if (!measurement.status.ok()) {
    measurement.status = named(measurement.status, geometry);
    return;
  }
  if (observer != nullptr) {
    observer->on_order(measurement.views.reference_view);
    observer->on_geometry(geometry.bundle, std::span(geometry.dishes).first(geometry.dish_count));
  }
  report_own_motion(geometry, measurement);
  report_pose(geometry, reversed, measurement);
  warn_about_angles({measurement.relative_angle_deg, measurement.rotation_angle_deg, views[0]->arm_angle_deg,
                     views[1]->arm_angle_deg},
                    configuration.geometry, measurement.warnings);
  warn_about_guessed_dishes(geometry, measurement.warnings);
  measurement.status = is_same_place(geometry)
                           ? StatusCode::views_identical
                           : check_angle(measurement.relative_angle_deg, configuration.geometry);
}

void measure_tray(TrayMemory& memory, const Configuration& configuration, const Segmentation* found,
                  std::uint64_t seed, StageObserver* observer, StageClock& clock, Measurement& measurement) {
  locate_tray(memory, configuration, found, seed, observer, clock, measurement);
  if (!measurement.status.ok()) return;
  const CheckedTray checked = in_order(memory, found);
  const ViewPair& views = checked.views;
  SceneGeometry& geometry = memory.scene.front();
  SurfaceMeasurementWorkspace workspace = memory.dish;
  clock.enter(Stage::stereo);
  warn_about_unknown_objects(checked, geometry, configuration, measurement);
  suppress_speculars(views, configuration.specular);
  const TrayAtWork tray{views, geometry, configuration, workspace, observer, clock, measurement};
  for (std::size_t d = 0; d < geometry.dish_count; ++d) measure_dish(tray, d);
  measure_tray_food(tray);
  check_table(geometry.table, configuration.checks, measurement.checks, measurement.warnings);
  if (measurement.report.dish_index >= 0) {
    const auto index = static_cast<std::size_t>(measurement.report.dish_index);
    measurement.views.dish_bottom =
        measurement.views.table.raised(configuration.dishes[index].bottom_height_mm);
  }
  measurement.status =
      workspace.items.empty() ? geometry.bundle.dishes[0].status : summarise(workspace.items.items());
  measurement.items = workspace.items.items();
  measurement.views.surfaces = workspace.surfaces.items();
}

}  // namespace traygauge
