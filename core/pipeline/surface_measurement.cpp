#include "core/pipeline/surface_measurement.hpp"

#include <algorithm>
#include <cmath>

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

// Height of the tallest sparse point on the surface, in the table frame; the bottom's without any.
double tallest_track_mm(const SceneGeometry& geometry, const FoodSurface& surface) {
  const TableCameras& cameras = geometry.bundle.camera_from_table;
  const Pose motion = second_from_first(cameras);
  double tallest_mm = surface.bottom_mm();
  for (const PointTrack& track : geometry.tracks) {
    if (!surface.labels.contains(track.label)) continue;
    Vec3 point_mm;
    if (triangulate_track(track, cameras[0], motion, point_mm))
      tallest_mm = std::max(tallest_mm, point_mm.z());
  }
  return tallest_mm;
}

// Status of one item, once its surface was measured.
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

template <class Action>
void for_each_item(const ViewPair& views, const LabelSet& labels, Action&& action) {
  for (int value = kFirstItemLabel; value <= kLastItemLabel; ++value) {
    const auto label = static_cast<std::uint8_t>(value);
    const bool seen = views[0]->regions().pixels[label] > 0 || views[1]->regions().pixels[label] > 0;
    if (seen && labels.contains(label)) action(label);
  }
}

// On the tray nothing but the pictures says where food ends, and next to what is smooth they do not: a napkin
// in the colour of food passes for it.
bool has_open_outline(const TrayAtWork& tray, const FoodSurface& surface, std::uint8_t label) {
  return is_tray_place(surface.dish) && tray.views[0]->are_outlines_found() &&
         tray.measurement.warnings.holds(Warning::little_texture, label);
}

// What one surface yields on the way to its volumes.
struct ItemsAtWork {
  const FoodSurface& surface;
  const MatchedSurface& matched;
  const LabelSet& round;
  const std::array<double, kByteValues>& matched_fractions;
  std::uint8_t liquid = 0;  // its label; 0: none
  double height_per_sample_mm = 0.0;
};

ItemResult measure_item(const TrayAtWork& tray, const ItemsAtWork& work, std::uint8_t label) {
  const Configuration& configuration = tray.configuration;
  const SceneGeometry& geometry = tray.geometry;
  const FoodSurface& surface = work.surface;
  const std::array<SurfaceGrid, 2>& grids = work.matched.grids;
  const HeightVolume& volume = tray.workspace.volume.items[label];
  Measurement& measurement = tray.measurement;
  ItemResult item;
  item.label = label;
  item.dish = surface.dish;
  item.status = judge_item(tray.views, label, volume, configuration);
  if (item.status == StatusCode::ok && has_open_outline(tray, surface, label))
    item.status = StatusCode::item_textureless;
  item.volume_ml = volume.volume_ml;
  item.column_volume_ml = volume.column_volume_ml;
  item.area_mm2 = volume.area_mm2;
  item.mean_height_mm = volume.mean_height_mm;
  item.max_height_mm = volume.max_height_mm;
  const bool is_measured = item.status == StatusCode::ok;
  const double matched = work.matched_fractions[label];
  measurement.warnings.raise_if(is_measured && matched < configuration.pipeline.min_matched_fraction,
                                Warning::item_hardly_matched, label);
  if (is_measured)
    item.status =
        check_item({label, label == work.liquid, tray.views[1]->lens.pinhole.mean_focal_px()}, geometry,
                   grids, surface.inner, configuration.checks, measurement.checks, measurement.warnings);
  // A liquid mirrors the lamp, which moves with the eye; its level is that of its outline.
  if (is_measured && label != work.liquid)
    check_likeness(label,
                   unlike_share(label, grids, tray.views, geometry.bundle.camera_from_table,
                                configuration.checks.pictures),
                   configuration.checks, measurement.checks, measurement.warnings);
  const UncertaintyInput input{volume,
                               matched,
                               work.height_per_sample_mm,
                               work.matched.dense.column_step_mm,
                               work.round.contains(label),
                               tray.views[0]->are_outlines_found(),
                               surface.shape_sigma_mm};
  item.sigma_ml = estimate_sigma_ml(input, geometry.bundle.camera_from_table, geometry.bundle.covariance,
                                    configuration.uncertainty);
  measurement.warnings.raise_if(
      is_measured && item.sigma_ml > configuration.pipeline.max_sigma_fraction * item.volume_ml,
      Warning::item_uncertain, label);
  measurement.warnings.raise_if(item.status == StatusCode::ok && is_tray_place(surface.dish),
                                Warning::item_beside_dishes, label);
  return item;
}

}  // namespace

void refuse_items(const TrayAtWork& tray, const LabelSet& labels, std::uint8_t dish, Status status) {
  for_each_item(tray.views, labels, [&](std::uint8_t label) {
    ItemResult item;
    item.label = label;
    item.dish = dish;
    item.status = status.code();
    tray.workspace.items.push_back(item);
  });
}

Result<MatchedSurface> match_on_surface(const TrayAtWork& tray, const FoodSurface& surface,
                                        const std::array<StoredView, 2>& views, const LabelTable& kept) {
  const Configuration& configuration = tray.configuration;
  SurfaceMeasurementWorkspace& workspace = tray.workspace;
  MeasurementReport& report = tray.measurement.report;
  tray.clock.enter(Stage::stereo);
  const double top_mm =
      std::max(tallest_track_mm(tray.geometry, surface) + configuration.pipeline.summit_margin_mm,
               surface.bottom_mm() + configuration.pipeline.min_top_mm);
  MatchedSurface matched;
  const Status status = run_dense_stereo(views, kept, surface.bottom_mm(), top_mm, configuration.surface,
                                         workspace.surface, matched.grids, matched.dense);
  if (!status.ok()) return status;
  report.rectified_rows = matched.dense.rows;
  report.rectified_columns = matched.dense.columns;
  report.disparity_range = matched.dense.disparity_range;
  report.matched_fraction = 0.5 * (matched.dense.confirmed[0] + matched.dense.confirmed[1]);
  for (std::size_t v = 0; v < 2; ++v) {
    DenseStereoWorkspace::View& view = workspace.surface.views[v];
    project_onto_dish(surface.inner, matched.grids[v], view.points, view.evidence);
  }
  return matched;
}

Status measure_on_surface(const TrayAtWork& tray, const FoodSurface& surface, MatchedSurface matched) {
  const Configuration& configuration = tray.configuration;
  const TableCameras& cameras = tray.geometry.bundle.camera_from_table;
  SurfaceMeasurementWorkspace& workspace = tray.workspace;
  MeasurementReport& report = tray.measurement.report;
  const InnerSurface& inner = surface.inner;
  std::array<SurfaceGrid, 2>& grids = matched.grids;
  const LabelSet round =
      shape_round_bodies({grids, {workspace.surface.views[0].points, workspace.surface.views[1].points}},
                         inner, configuration.round_body, workspace.round_body);
  if (tray.observer != nullptr) tray.observer->on_surfaces(cameras, grids);
  report.label_agreement = measure_food_agreement(grids, tray.views, cameras, configuration.agreement);
  if (report.label_agreement < configuration.agreement.min_fraction) return StatusCode::labels_inconsistent;

  tray.clock.enter(Stage::surface);
  if (workspace.surfaces.full()) return StatusCode::too_many_dishes;
  HeightMap map;
  Status status =
      build_height_map(grids, inner, configuration.height_map, workspace.cells, workspace.height_map, map);
  if (!status.ok()) return status;
  workspace.cells = workspace.cells.subspan(static_cast<std::size_t>(map.cells.width) *
                                            static_cast<std::size_t>(map.cells.height));
  workspace.surfaces.push_back({surface.dish, map, inner});

  tray.clock.enter(Stage::volume);
  std::array<double, kByteValues> fractions = matched_fractions(grids);
  LevelLiquid liquid;
  if (!is_tray_place(surface.dish))
    liquid = level_liquid(grids, inner, configuration.liquid, workspace.liquid, map);
  if (liquid.label != 0) fractions[liquid.label] = 1.0;  // its outline says how high it stands
  status = integrate_height_map(map, inner, configuration.volume, workspace.volume);
  if (!status.ok()) return status;
  close_overhangs(grids, map, inner, round, configuration.overhang, workspace.volume.items);
  const Vec2& centre = inner.place.centre_mm;
  const double height_per_px_mm = height_per_sample_mm(cameras, {centre.x(), centre.y(), surface.bottom_mm()},
                                                       matched.dense.column_step_mm);
  const ItemsAtWork work{surface, matched, round, fractions, liquid.label, height_per_px_mm};
  for_each_item(tray.views, surface.labels,
                [&](std::uint8_t label) { workspace.items.push_back(measure_item(tray, work, label)); });
  return {};
}

}  // namespace traygauge
