#include "core/pipeline/tray_checks.hpp"

#include <algorithm>
#include <cmath>

namespace traygauge {
namespace {

using Sightings = std::array<DishSighting, 2>;

// In the order of the cameras.
Sightings found_sightings(const CheckedTray& tray, std::uint8_t label) {
  Sightings sightings;
  for (const SegmentedDish& dish : tray.found->sought()) {
    if (dish.label == label) sightings = dish.sightings;
  }
  if (tray.is_reversed) std::swap(sightings[0], sightings[1]);
  return sightings;
}

// From the outlines that were given, about where the dish stands.
Sightings given_sightings(const CheckedTray& tray, const SceneGeometryWorkspace& workspace,
                          const DishSightingParams& params, const TableCameras& cameras,
                          const DishPose& about, std::size_t index) {
  Sightings sightings;
  for (std::size_t v = 0; v < 2; ++v) {
    sightings[v] = sight_dish(workspace.outlines[index][v].items(), cameras[v],
                              tray.views[v]->lens.pinhole.mean_focal_px(), about, params);
  }
  return sightings;
}

DishPose as_described(DishPose place, const DishModel& model) {
  place.size_mm = model.outer_size_mm;
  place.edge_height_mm = edge_height_mm(model);
  return place;
}

bool are_known(const Sightings& sightings) {
  return sightings[0].is_known && sightings[1].is_known;
}

struct Finding {
  Verdict verdict = Verdict::passed;
  DishFault fault = DishFault::slip;
};

Finding add_checks(const DishConsistency& dish, std::uint8_t label, const TrayCheckParams& params,
                   CheckList& checks) {
  Finding finding;
  const bool is_wrong = dish.squared_deviation > params.max_squared_deviation;
  finding.fault = dish.best_fault();
  const auto add = [&](DishFault fault, CheckKind kind, double value, double sigma, double warning,
                       double most) {
    Check check{kind, label, value, sigma, warning, Verdict::passed};
    if (is_wrong && fault == finding.fault) finding.verdict = check.verdict = judge(value, warning, most);
    checks.add(check);
  };
  add(DishFault::slip, CheckKind::dish_slip_mm, dish.slip_mm.norm(), dish.slip_sigma_mm,
      params.slip_warning_mm, params.max_slip_mm);
  add(DishFault::scale, CheckKind::scale_percent, 100.0 * dish.scale, 100.0 * dish.scale_sigma,
      100.0 * params.scale_warning, 100.0 * params.max_scale);
  add(DishFault::height, CheckKind::dish_height_mm, dish.height_mm, dish.height_sigma_mm,
      params.height_warning_mm, params.max_height_mm);
  return finding;
}

Warning warning_of(DishFault fault) {
  if (fault == DishFault::scale) return Warning::scale_disagrees;
  if (fault == DishFault::height) return Warning::card_lifted;
  return Warning::dish_moved;
}

StatusCode status_of(DishFault fault) {
  if (fault == DishFault::scale) return StatusCode::scale_disagrees;
  if (fault == DishFault::height) return StatusCode::card_lifted;
  return StatusCode::dish_moved;
}

}  // namespace

void check_dishes(const CheckedTray& tray, const SceneGeometryWorkspace& workspace,
                  const Configuration& configuration, SceneGeometry& geometry, CheckList& checks,
                  WarningSet& warnings) {
  const TrayCheckParams& params = configuration.checks;
  const BundleResult& bundle = geometry.bundle;
  const CamerasMatrix covariance = bundle.covariance.topLeftCorner<kCameraParameters, kCameraParameters>();
  for (std::size_t d = 0; d < geometry.dish_count; ++d) {
    if (!bundle.dishes[d].status.ok()) continue;
    DishOnTray& dish = geometry.dishes[d];
    const PlacedDish& placed = bundle.dishes[d].placed;
    const DishPose about =
        as_described(placed.place, dish.candidates[static_cast<std::size_t>(placed.candidate)]);
    const Sightings sightings = tray.found != nullptr ? found_sightings(tray, dish.label)
                                                      : given_sightings(tray, workspace, params.sighting,
                                                                        bundle.camera_from_table, about, d);
    if (!are_known(sightings)) continue;
    const DishConsistency consistency =
        compare_sightings(sightings, bundle.camera_from_table, covariance,
                          mean_size_mm(bundle.dishes[d].placed.place), params.consistency);
    const Finding finding = add_checks(consistency, dish.label, params, checks);
    if (finding.verdict == Verdict::refused) dish.verdict = status_of(finding.fault);
    warnings.raise_if(finding.verdict == Verdict::warned, warning_of(finding.fault), dish.label);
  }
}

}  // namespace traygauge
