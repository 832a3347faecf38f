#include "core/pipeline/dish_measurement.hpp"

#include <cmath>

#include "core/pipeline/bare_checks.hpp"
#include "core/pipeline/dish_observation.hpp"
#include "core/pipeline/tray_checks.hpp"

namespace traygauge {
namespace {

// Without a profile the surface may lie anywhere between bottom and rim: of a uniform distribution.
double unknown_shape_sigma_mm(const DishModel& model) {
  return model.has_profile() ? 0.0 : (model.rim_height_mm - model.bottom_height_mm) / std::sqrt(12.0);
}

// Where the dish stands must be known before anything on it can be measured.
Status check_place(const TrayAtWork& tray, std::size_t index) {
  const DishOnTray& dish = tray.geometry.dishes[index];
  const BundleDishResult& placed = tray.geometry.bundle.dishes[index];
  if (!placed.status.ok()) return placed.status;
  if (!dish.verdict.ok()) return dish.verdict;
  for (const TrayView* view : tray.views) {
    if (is_cut_off(*view, dish.labels)) return StatusCode::dish_cut_off;
  }
  MeasurementReport& report = tray.measurement.report;
  report.rim_height_mm = placed.placed.place.edge_height_mm;
  report.rim_rms_px = placed.placed.fit.rms_px;
  report.rim_inlier_fraction = placed.placed.fit.explained_fraction();
  const DishModel& model = dish.candidates[static_cast<std::size_t>(placed.placed.candidate)];
  report.dish_index = static_cast<int>(&model - tray.configuration.dishes.data());
  return report.rim_inlier_fraction < tray.configuration.pipeline.min_rim_inlier_fraction
             ? StatusCode::labels_inconsistent
             : StatusCode::ok;
}

Status measure_placed_dish(const TrayAtWork& tray, std::size_t index) {
  Status status = check_place(tray, index);
  if (!status.ok()) return status;
  const Configuration& configuration = tray.configuration;
  const DishOnTray& dish = tray.geometry.dishes[index];
  const PlacedDish& placed = tray.geometry.bundle.dishes[index].placed;
  const DishModel& model = dish.candidates[static_cast<std::size_t>(placed.candidate)];
  const TableCameras& cameras = tray.geometry.bundle.camera_from_table;
  Measurement& measurement = tray.measurement;
  measurement.warnings.raise_if(!model.has_profile(), Warning::dish_shape_unknown, dish.label);
  FoodSurface surface{dish.label, dish.labels, {}, unknown_shape_sigma_mm(model)};
  surface.inner.place = frame_of(placed.place);
  status = surface.inner.profile.set(model);
  if (!status.ok()) return status;
  const Result<MatchedSurface> matched = match_on_surface(
      tray, surface, diffuse_views(tray.views, cameras, dish.labels), labels_on_dish(dish.labels));
  if (!matched.ok()) return matched.status();
  const auto glaze = find_glaze(tray.views, cameras, matched->grids[0], surface.inner, dish.label,
                                configuration.checks.bare);
  status = check_glaze(glaze, dish.label, tray.geometry.table, configuration.checks, measurement.checks,
                       measurement.warnings);
  return status.ok() ? measure_on_surface(tray, surface, *matched) : status;
}

}  // namespace

void measure_dish(const TrayAtWork& tray, std::size_t index) {
  const Status status = measure_placed_dish(tray, index);
  const DishOnTray& dish = tray.geometry.dishes[index];
  if (!status.ok()) refuse_items(tray, dish.labels, dish.label, status);
}

}  // namespace traygauge
