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

// From the outlines that were given.
Sightings given_sightings(const CheckedTray& tray, const SceneGeometryWorkspace& workspace,
                          const DishSightingParams& params, const SceneGeometry& geometry,
                          std::size_t index) {
  const BundleDishResult& dish = geometry.bundle.dishes[index];
  const DishModel& model = geometry.dishes[index].candidates[static_cast<std::size_t>(dish.placed.candidate)];
  DishPose about = dish.placed.place;
  about.size_mm = model.outer_size_mm;
  about.edge_height_mm = edge_height_mm(model);
  Sightings sightings;
  for (std::size_t v = 0; v < 2; ++v) {
    sightings[v] = sight_dish(workspace.outlines[index][v].items(), geometry.bundle.camera_from_table[v],
                              tray.views[v]->lens.pinhole.mean_focal_px(), about, params);
  }
  return sightings;
}

bool are_known(const Sightings& sightings) {
  return sightings[0].is_known && sightings[1].is_known;
}

double mean_size_mm(const DishPose& place) {
  return 0.5 * (place.size_mm[0] + place.size_mm[1]);
}

// The one that leaves least unexplained. A slip has one degree of freedom more than the others.
DishFault best_fault(const DishConsistency& dish) {
  const double slip = dish.left[static_cast<std::size_t>(DishFault::slip)] + 1.0;
  const double scale = dish.left[static_cast<std::size_t>(DishFault::scale)];
  const double height = dish.left[static_cast<std::size_t>(DishFault::height)];
  if (slip <= scale && slip <= height) return DishFault::slip;
  return scale <= height ? DishFault::scale : DishFault::height;
}

struct Finding {
  Verdict verdict = Verdict::passed;
  DishFault fault = DishFault::slip;
};

Finding add_checks(const DishConsistency& dish, std::uint8_t label, const TrayCheckParams& params,
                   CheckList& checks) {
  Finding finding;
  const bool is_wrong = dish.squared_deviation > params.max_squared_deviation;
  finding.fault = best_fault(dish);
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

Status check_standstill(const CheckedTray& tray, const Configuration& configuration, CheckList& checks) {
  if (tray.found == nullptr) return StatusCode::ok;
  const TrayCheckParams& params = configuration.checks;
  TableCameras cameras;
  CamerasMatrix covariance = CamerasMatrix::Zero();
  for (std::size_t v = 0; v < 2; ++v) {
    cameras[v] = tray.views[v]->card().camera_from_table;
    const auto at = static_cast<Eigen::Index>(6 * v);
    covariance.block<6, 6>(at, at) = inverse_information<6>(tray.views[v]->card().information);
  }
  Status status;
  for (const SegmentedDish& dish : tray.found->sought()) {
    const Sightings sightings = found_sightings(tray, dish.label);
    if (!dish.status.ok() || !are_known(sightings)) continue;
    const DishConsistency consistency =
        compare_sightings(sightings, cameras, covariance, mean_size_mm(dish.found.place), params.consistency);
    CheckList of_dish;
    const Finding finding = add_checks(consistency, dish.label, params, of_dish);
    if (finding.fault != DishFault::slip || finding.verdict != Verdict::refused) continue;
    if (consistency.slip_mm.norm() < params.hopeless_slip_mm) continue;
    for (const Check& check : of_dish.items()) checks.add(check);
    status = StatusCode::dish_moved;
  }
  return status;
}

void check_dishes(const CheckedTray& tray, const SceneGeometryWorkspace& workspace,
                  const Configuration& configuration, SceneGeometry& geometry, CheckList& checks,
                  WarningSet& warnings) {
  const TrayCheckParams& params = configuration.checks;
  const BundleResult& bundle = geometry.bundle;
  const CamerasMatrix covariance = bundle.covariance.topLeftCorner<kCameraParameters, kCameraParameters>();
  for (std::size_t d = 0; d < geometry.dish_count; ++d) {
    if (!bundle.dishes[d].status.ok()) continue;
    DishOnTray& dish = geometry.dishes[d];
    const Sightings sightings = tray.found != nullptr
                                    ? found_sightings(tray, dish.label)
                                    : given_sightings(tray, workspace, params.sighting, geometry, d);
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
