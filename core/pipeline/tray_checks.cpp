#include "core/pipeline/tray_checks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

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

// Beyond its own errors.
bool is_significant(const AgreedHeight& height, const TrayCheckParams& params) {
  return height.is_known && std::abs(height.offset_mm) > params.max_glaze_sigmas * height.sigma_mm;
}

bool is_where_it_belongs(const AgreedHeight& height, const TrayCheckParams& params) {
  return height.is_known && std::abs(height.offset_mm) <= params.height_warning_mm;
}

bool is_height(const Check& check) {
  return check.kind == CheckKind::dish_height_mm || check.kind == CheckKind::glaze_height_mm;
}

struct Finding {
  Verdict verdict = Verdict::passed;
  DishFault fault = DishFault::slip;
};

// One fault of a dish, and when it is told.
struct FaultCheck {
  Check check;
  double most = 0.0;       // beyond it, refused
  double by_chance = 0.0;  // what it may explain
};

// In the order of DishFault.
std::array<FaultCheck, kDishFaults> checks_of(const DishConsistency& dish, std::uint8_t label,
                                              const TrayCheckParams& params) {
  constexpr double kPercent = 100.0;
  return {
      {{{CheckKind::dish_slip_mm, label, dish.slip_mm.norm(), dish.slip_sigma_mm, params.slip_warning_mm},
        params.max_slip_mm,
        params.max_explained_by_slip},
       {{CheckKind::scale_percent, label, kPercent * dish.scale, kPercent * dish.scale_sigma,
         kPercent * params.scale_warning},
        kPercent * params.max_scale,
        params.max_explained_by_size},
       {{CheckKind::dish_height_mm, label, dish.height_mm, dish.height_sigma_mm, params.height_warning_mm},
        params.max_height_mm,
        params.max_explained_by_size}}};
}

// The fault that explains most, of those that are more than chance and too large.
Finding find_fault(const DishConsistency& dish, const std::array<FaultCheck, kDishFaults>& faults) {
  for (const DishFault fault : dish.best_first()) {
    const FaultCheck& of_fault = faults[static_cast<std::size_t>(fault)];
    if (dish.explained_by(fault) <= of_fault.by_chance) continue;
    const Verdict verdict = judge(of_fault.check.value, of_fault.check.limit, of_fault.most);
    if (verdict != Verdict::passed) return {verdict, fault};
  }
  return {};
}

// Told only of a dish with which nothing else is wrong: a card that leans looks lifted as well, and either
// way it has to be laid flat.
Verdict add_lean_check(const DishConsistency& dish, std::uint8_t label, bool is_right_otherwise,
                       const TrayCheckParams& params, CheckList& checks) {
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  Check check{CheckKind::dish_lean_deg, label, kDegrees * dish.lean_rad, kDegrees * dish.lean_sigma_rad,
              params.lean_warning_deg};
  if (check.sigma > params.most_lean_sigma_deg) return Verdict::passed;
  if (is_right_otherwise && dish.lean_deviation > params.max_explained_by_size)
    check.verdict = judge(check.value, params.lean_warning_deg, params.max_lean_deg);
  checks.add(check);
  return check.verdict;
}

Finding add_checks(const DishConsistency& dish, std::uint8_t label, const TrayCheckParams& params,
                   CheckList& checks) {
  std::array<FaultCheck, kDishFaults> faults = checks_of(dish, label, params);
  const Finding finding = find_fault(dish, faults);
  faults[static_cast<std::size_t>(finding.fault)].check.verdict = finding.verdict;
  for (const FaultCheck& of_fault : faults) checks.add(of_fault.check);
  return finding;
}

// A dish that lies elsewhere than described does so because the card does, but not where the table around the
// card, or another part of the dish, lies where it belongs: `ruler`.
Warning height_warning(const AgreedHeight& ruler, const TrayCheckParams& params) {
  return is_where_it_belongs(ruler, params) ? Warning::dish_differs : Warning::card_lifted;
}

StatusCode height_status(const AgreedHeight& ruler, const TrayCheckParams& params) {
  return is_where_it_belongs(ruler, params) ? StatusCode::dish_differs : StatusCode::card_lifted;
}

Warning warning_of(DishFault fault, const AgreedHeight& table, const TrayCheckParams& params) {
  if (fault == DishFault::scale) return Warning::scale_disagrees;
  if (fault == DishFault::height) return height_warning(table, params);
  return Warning::dish_moved;
}

StatusCode status_of(DishFault fault, const AgreedHeight& table, const TrayCheckParams& params) {
  if (fault == DishFault::scale) return StatusCode::scale_disagrees;
  if (fault == DishFault::height) return height_status(table, params);
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
    if (finding.verdict == Verdict::refused) dish.verdict = status_of(finding.fault, geometry.table, params);
    warnings.raise_if(finding.verdict == Verdict::warned, warning_of(finding.fault, geometry.table, params),
                      dish.label);
    const Verdict lean =
        add_lean_check(consistency, dish.label, finding.verdict == Verdict::passed, params, checks);
    if (lean == Verdict::refused) dish.verdict = StatusCode::card_not_flat;
    warnings.raise_if(lean == Verdict::warned, Warning::card_not_flat, dish.label);
  }
}

StatusCode check_glaze(std::span<const AgreedHeight> bands, std::uint8_t dish, const AgreedHeight& table,
                       const TrayCheckParams& params, CheckList& checks, WarningSet& warnings) {
  // The band that is surely furthest off, or the one that is known best.
  const auto is_worse = [&](const AgreedHeight& a, const AgreedHeight& b) {
    if (a.is_known != b.is_known) return a.is_known;
    const bool is_off = is_significant(a, params);
    if (is_off != is_significant(b, params)) return is_off;
    return is_off ? std::abs(a.offset_mm) > std::abs(b.offset_mm) : a.sigma_mm < b.sigma_mm;
  };
  const AgreedHeight& worst = *std::ranges::min_element(bands, is_worse);
  if (!worst.is_known) return StatusCode::ok;
  Check check{CheckKind::glaze_height_mm, dish, worst.offset_mm, worst.sigma_mm, params.height_warning_mm};
  if (is_significant(worst, params))
    check.verdict = judge(worst.offset_mm, params.height_warning_mm, params.max_height_mm);
  checks.add(check);
  const auto right = std::ranges::find_if(
      bands, [&](const AgreedHeight& band) { return is_where_it_belongs(band, params); });
  const AgreedHeight& ruler = right == bands.end() ? table : *right;
  warnings.raise_if(check.verdict == Verdict::warned, height_warning(ruler, params), dish);
  return check.verdict == Verdict::refused ? height_status(ruler, params) : StatusCode::ok;
}

void check_table(const AgreedHeight& table, const TrayCheckParams& params, CheckList& checks,
                 WarningSet& warnings) {
  if (!table.is_known) return;
  Check check{CheckKind::table_height_mm, kCardLabel, table.offset_mm, table.sigma_mm,
              params.height_warning_mm};
  const bool is_dish_known = std::ranges::any_of(checks.items(), is_height);
  if (!is_dish_known && is_significant(table, params) && !is_where_it_belongs(table, params))
    check.verdict = Verdict::warned;
  checks.add(check);
  warnings.raise_if(check.verdict == Verdict::warned, Warning::card_lifted, kCardLabel);
}

}  // namespace traygauge
