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

Check check_of(const DishConsistency& dish, DishFault fault, std::uint8_t label,
               const TrayCheckParams& params) {
  if (fault == DishFault::slip)
    return {CheckKind::dish_slip_mm, label, dish.slip_mm.norm(), dish.slip_sigma_mm, params.slip_warning_mm};
  if (fault == DishFault::scale)
    return {CheckKind::scale_percent, label, 100.0 * dish.scale, 100.0 * dish.scale_sigma,
            100.0 * params.scale_warning};
  return {CheckKind::dish_height_mm, label, dish.height_mm, dish.height_sigma_mm, params.height_warning_mm};
}

double most_of(DishFault fault, const TrayCheckParams& params) {
  if (fault == DishFault::slip) return params.max_slip_mm;
  return fault == DishFault::scale ? 100.0 * params.max_scale : params.max_height_mm;
}

// The fault that explains most, of those that are more than chance and too large.
Finding find_fault(const DishConsistency& dish, const std::array<Check, kDishFaults>& checks,
                   const TrayCheckParams& params) {
  for (const DishFault fault : dish.best_first()) {
    const double by_chance =
        fault == DishFault::slip ? params.max_explained_by_slip : params.max_explained_by_size;
    if (dish.explained_by(fault) <= by_chance) continue;
    const Check& check = checks[static_cast<std::size_t>(fault)];
    const Verdict verdict = judge(check.value, check.limit, most_of(fault, params));
    if (verdict != Verdict::passed) return {verdict, fault};
  }
  return {};
}

Finding add_checks(const DishConsistency& dish, std::uint8_t label, const TrayCheckParams& params,
                   CheckList& checks) {
  std::array<Check, kDishFaults> of_dish{check_of(dish, DishFault::slip, label, params),
                                         check_of(dish, DishFault::scale, label, params),
                                         check_of(dish, DishFault::height, label, params)};
  const Finding finding = find_fault(dish, of_dish, params);
  of_dish[static_cast<std::size_t>(finding.fault)].verdict = finding.verdict;
  for (const Check& check : of_dish) checks.add(check);
  return finding;
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

}  // namespace

Warning height_warning(const AgreedHeight& table, const TrayCheckParams& params) {
  return is_where_it_belongs(table, params) ? Warning::dish_differs : Warning::card_lifted;
}

StatusCode height_status(const AgreedHeight& table, const TrayCheckParams& params) {
  return is_where_it_belongs(table, params) ? StatusCode::dish_differs : StatusCode::card_lifted;
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
  // A card that lies on something puts all bands alike elsewhere.
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
