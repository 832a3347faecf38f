#include "core/pipeline/dish_measurement.hpp"

#include <algorithm>
#include <cmath>

#include "core/pipeline/bare_checks.hpp"
#include "core/pipeline/dish_observation.hpp"
#include "core/pipeline/food_agreement.hpp"
#include "core/pipeline/item_checks.hpp"
#include "core/pipeline/picture_agreement.hpp"
#include "core/pipeline/tray_checks.hpp"
#include "core/stereo/dish_projection.hpp"
#include "core/volume/matched_fraction.hpp"
#include "core/volume/uncertainty.hpp"

namespace traygauge {
namespace {

// Height of the tallest sparse point on the dish, in the table frame; the bottom's without any.
double tallest_track_mm(const SceneGeometry& geometry, const LabelSet& labels, double bottom_height_mm) {
  const TableCameras& cameras = geometry.bundle.camera_from_table;
  const Pose motion = second_from_first(cameras);
  double tallest_mm = bottom_height_mm;
  for (const PointTrack& track : geometry.tracks) {
    if (!labels.contains(track.label)) continue;
    Vec3 point_mm;
    if (triangulate_track(track, cameras[0], motion, point_mm))
      tallest_mm = std::max(tallest_mm, point_mm.z());
  }
  return tallest_mm;
}

// Status of one item, once its dish was measured.
StatusCode judge_item(const ViewPair& views, std::uint8_t label, const HeightVolume& volume,
                      const Configuration& configuration) {
  const std::uint32_t first_px = views[0]->regions().pixels[label];
  const std::uint32_t second_px = views[1]->regions().pixels[label];
  if (first_px == 0 || second_px == 0) return StatusCode::item_hidden;
  if (std::min(first_px, second_px) < static_cast<std::uint32_t>(configuration.pipeline.min_item_px)) {
    return StatusCode::item_too_small;
  }
  const StatusCode pixels =
      judge_item_pixels(label, views[0]->quality(), views[1]->quality(), configuration.view_checks);
  if (pixels != StatusCode::ok) return pixels;
  if (!(volume.area_mm2 > 0.0)) return StatusCode::too_little_depth;
  return volume.volume_ml > 0.0 ? StatusCode::ok : StatusCode::item_below_dish;
}

// Without a profile the surface may lie anywhere between bottom and rim: of a uniform distribution.
double unknown_shape_sigma_mm(const DishModel& model) {
  return model.has_profile() ? 0.0 : (model.rim_height_mm - model.bottom_height_mm) / std::sqrt(12.0);
}

template <class Action>
void for_each_item(const ViewPair& views, const DishOnTray& dish, Action&& action) {
  for (int value = kFirstItemLabel; value <= kLastItemLabel; ++value) {
    const auto label = static_cast<std::uint8_t>(value);
    const bool seen = views[0]->regions().pixels[label] > 0 || views[1]->regions().pixels[label] > 0;
    if (seen && dish.labels.contains(label)) action(label);
  }
}

}  // namespace

void measure_dish(const ViewPair& views, const SceneGeometry& geometry, std::size_t index,
                  const Configuration& configuration, DishMeasurementWorkspace& workspace,
                  StageObserver* observer, StageClock& clock, Measurement& measurement) {
  MeasurementReport& report = measurement.report;
  const DishOnTray& dish = geometry.dishes[index];
  const auto refuse = [&](Status status) {
    for_each_item(views, dish, [&](std::uint8_t label) {
      ItemResult item;
      item.label = label;
      item.dish = dish.label;
      item.status = status.code();
      workspace.items.push_back(item);
    });
  };
  const BundleDishResult& placed = geometry.bundle.dishes[index];
  if (!placed.status.ok()) return refuse(placed.status);
  if (!dish.verdict.ok()) return refuse(dish.verdict);
  for (const TrayView* view : views) {
    if (is_cut_off(*view, dish.labels)) return refuse(StatusCode::dish_cut_off);
  }
  const DishModel& model = dish.candidates[static_cast<std::size_t>(placed.placed.candidate)];
  report.rim_height_mm = placed.placed.place.edge_height_mm;
  report.rim_rms_px = placed.placed.fit.rms_px;
  report.rim_inlier_fraction = placed.placed.fit.explained_fraction();
  report.dish_index = static_cast<int>(&model - configuration.dishes.data());
  if (report.rim_inlier_fraction < configuration.pipeline.min_rim_inlier_fraction)
    return refuse(StatusCode::labels_inconsistent);

  clock.enter(Stage::stereo);
  const double bottom_mm = model.bottom_height_mm;
  const double top_mm =
      std::max(tallest_track_mm(geometry, dish.labels, bottom_mm) + configuration.pipeline.summit_margin_mm,
               bottom_mm + configuration.pipeline.min_top_mm);
  std::array<SurfaceGrid, 2> grids;
  DenseStereoReport dense;
  InnerSurface inner;
  inner.place = frame_of(placed.placed.place);
  measurement.warnings.raise_if(!model.has_profile(), Warning::dish_shape_unknown, dish.label);
  Status status = inner.profile.set(model);
  if (!status.ok()) return refuse(status);
  status = run_dense_stereo(diffuse_views(views, geometry.bundle.camera_from_table, dish.labels),
                            labels_on_dish(dish.labels), bottom_mm, top_mm, configuration.surface,
                            workspace.surface, grids, dense);
  if (!status.ok()) return refuse(status);
  report.rectified_rows = dense.rows;
  report.rectified_columns = dense.columns;
  report.disparity_range = dense.disparity_range;
  report.matched_fraction = 0.5 * (dense.confirmed[0] + dense.confirmed[1]);

  for (std::size_t v = 0; v < 2; ++v) {
    DenseStereoWorkspace::View& view = workspace.surface.views[v];
    project_onto_dish(inner, grids[v], view.points, view.evidence);
  }
  const auto glaze = find_glaze(views, geometry.bundle.camera_from_table, grids[0], inner, dish.label,
                                configuration.checks.bare);
  status = check_glaze(glaze, dish.label, geometry.table, configuration.checks, measurement.checks,
                       measurement.warnings);
  if (!status.ok()) return refuse(status);
  const LabelSet round =
      shape_round_bodies({grids, {workspace.surface.views[0].points, workspace.surface.views[1].points}},
                         inner, configuration.round_body, workspace.round_body);
  if (observer != nullptr) observer->on_surfaces(geometry.bundle.camera_from_table, grids);
  report.label_agreement =
      measure_food_agreement(grids, views, geometry.bundle.camera_from_table, configuration.agreement);
  if (report.label_agreement < configuration.agreement.min_fraction)
    return refuse(StatusCode::labels_inconsistent);

  clock.enter(Stage::surface);
  HeightMapWorkspace maps = workspace.height_map;
  maps.first = workspace.cells;
  HeightMap map;
  status = build_height_map(grids, inner, configuration.height_map, maps, map);
  if (!status.ok()) return refuse(status);
  workspace.cells = workspace.cells.subspan(static_cast<std::size_t>(map.cells.width) *
                                            static_cast<std::size_t>(map.cells.height));
  workspace.surfaces.push_back({dish.label, map, inner});

  clock.enter(Stage::volume);
  std::array<double, 256> matched = matched_fractions(grids);
  const LevelLiquid liquid = level_liquid(grids, inner, configuration.liquid, workspace.liquid, map);
  if (liquid.label != 0) matched[liquid.label] = 1.0;  // its outline says how high it stands
  status = integrate_height_map(map, inner, configuration.volume, workspace.volume);
  if (!status.ok()) return refuse(status);
  close_overhangs(grids, map, inner, round, configuration.overhang, workspace.volume.items);
  const double height_per_px_mm = height_per_sample_mm(
      geometry.bundle.camera_from_table, middle_of(placed.placed.place, bottom_mm), dense.column_step_mm);
  for_each_item(views, dish, [&](std::uint8_t label) {
    const HeightVolume& volume = workspace.volume.items[label];
    ItemResult item;
    item.label = label;
    item.dish = dish.label;
    item.status = judge_item(views, label, volume, configuration);
    item.volume_ml = volume.volume_ml;
    item.column_volume_ml = volume.column_volume_ml;
    item.area_mm2 = volume.area_mm2;
    item.mean_height_mm = volume.mean_height_mm;
    item.max_height_mm = volume.max_height_mm;
    const bool is_measured = item.status == StatusCode::ok;
    measurement.warnings.raise_if(is_measured && matched[label] < configuration.pipeline.min_matched_fraction,
                                  Warning::item_hardly_matched, label);
    if (is_measured)
      item.status = check_item({label, dish.label, views[1]->lens.pinhole.mean_focal_px()}, geometry, grids,
                               inner, configuration.checks, measurement.checks, measurement.warnings);
    // A liquid mirrors the lamp, which moves with the eye; its level is that of its outline.
    if (is_measured && label != liquid.label)
      check_likeness(
          label,
          unlike_share(label, grids, views, geometry.bundle.camera_from_table, configuration.checks.pictures),
          configuration.checks, measurement.checks, measurement.warnings);
    const UncertaintyInput input{volume,
                                 matched[label],
                                 height_per_px_mm,
                                 dense.column_step_mm,
                                 round.contains(label),
                                 views[0]->are_outlines_found,
                                 unknown_shape_sigma_mm(model)};
    item.sigma_ml = estimate_sigma_ml(input, geometry.bundle.camera_from_table, geometry.bundle.covariance,
                                      configuration.uncertainty);
    measurement.warnings.raise_if(
        is_measured && item.sigma_ml > configuration.pipeline.max_sigma_fraction * item.volume_ml,
        Warning::item_uncertain, label);
    workspace.items.push_back(item);
  });
}

}  // namespace traygauge
