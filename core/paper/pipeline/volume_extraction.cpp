#include "core/paper/pipeline/volume_extraction.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/paper/base/half_sample_mode.hpp"

namespace traygauge::paper {
namespace {

// Which of the candidate dishes stands there; −1 when none fits.
int identify_dish(const VolumeExtractionWorkspace& workspace, const Configuration& configuration,
                  const Plane& rim, double rim_height_mm) {
  const Result<RimEllipse> ellipse = fit_rim_size(workspace.rim.points_mm.items(), rim);
  if (!ellipse.ok()) return -1;
  std::array<DishCandidate, kMaxDishCandidates> candidates{};
  for (std::size_t i = 0; i < configuration.dishes.size(); ++i) {
    candidates[i] = {configuration.dishes[i].outer_size_mm, configuration.dishes[i].rim_height_mm};
  }
  return choose_dish(std::span(candidates).first(configuration.dishes.size()), ellipse->size_mm,
                     rim_height_mm, configuration.dish_choice);
}

// A rim that belongs to no known dish: are the outlines wrong, or is it another dish? The dense depth just
// inside the reference view's outline tells.
StatusCode judge_unknown_dish(const ReferencePair& pair, ImageView<const float> depth_mm, const Plane& rim,
                              const Configuration& configuration, VolumeExtractionWorkspace& workspace) {
  const PreparedView& view = *pair.reference;
  const Status crest =
      collect_rim_crest(view.working_labels, depth_mm, view.cutout.camera, configuration.rim, workspace.rim);
  if (!crest.ok()) return StatusCode::labels_inconsistent;
  const auto points = workspace.rim.points_mm.items();
  const std::size_t count = std::min(points.size(), workspace.dish.heights_mm.size());
  const auto heights = workspace.dish.heights_mm.first(count);
  std::transform(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(count), heights.begin(),
                 [&](const Vec3& point) { return rim.height(point); });
  std::sort(heights.begin(), heights.end());
  const double deviation_mm = half_sample_mode(heights, configuration.dish.mode);
  return std::abs(deviation_mm) > configuration.rim_check.max_depth_deviation_mm
             ? StatusCode::labels_inconsistent
             : StatusCode::dish_unknown;
}

bool is_level(const Plane& rim, const Plane& table, const RimCheckParams& params) {
  return rim.normal.dot(table.normal) >= std::cos(params.max_tilt_deg * std::numbers::pi / 180.0);
}

// Why this item has no volume, or ok.
StatusCode judge_item(std::uint8_t label, const ReferencePair& pair, const FoodMesh& mesh,
                      const ItemVolume& volume, const Configuration& configuration) {
  const VolumeExtractionParams& params = configuration.extraction;
  const auto min_px = static_cast<std::uint32_t>(params.min_item_px);
  const std::uint32_t in_reference = mesh.coverage[label].label_px;
  const std::uint32_t in_other = pair.other->regions.pixels[label];
  if (in_reference == 0 || in_other == 0) return StatusCode::item_hidden;
  if (in_reference < min_px) return StatusCode::item_too_small;
  const StatusCode pixels =
      judge_item_pixels(label, pair.reference->quality(), pair.other->quality(), configuration.view_checks);
  if (pixels != StatusCode::ok) return pixels;
  if (mesh.coverage[label].share() < params.min_covered_fraction) return StatusCode::too_little_depth;
  return volume.volume_ml > 0.0 ? StatusCode::ok : StatusCode::item_below_dish;
}

}  // namespace

Status find_dish_bottom(const ReferencePair& pair, const TableReference& table,
                        const Configuration& configuration, Random& random,
                        VolumeExtractionWorkspace& workspace, MeasurementReport& report,
                        WorkingPictures& pictures, MeasurementViews& views) {
  const RimInput rim_input{pair.reference->working_labels, pair.other->working_labels, pair.cameras()};
  Status status = collect_rim_points(rim_input, configuration.rim, workspace.rim);
  if (!status.ok()) return status;
  PlaneFit rim;
  status = fit_rim_plane(pair.other_from_reference, configuration.rim, random, workspace.rim.points_mm, rim);
  if (!status.ok()) return status;
  report.rim_points = rim.inliers;

  const auto rim_points = workspace.rim.points_mm.items().first(static_cast<std::size_t>(rim.inliers));
  if (!is_level(rim.plane, table.table, configuration.rim_check)) return StatusCode::labels_inconsistent;
  const DishInput dish_input{rim.plane, rim_points, table.table, table.card_points,
                             configuration.card.thickness_mm};
  status = measure_rim_height(dish_input, configuration.dish, workspace.dish, report.rim_height_mm);
  if (!status.ok()) return status;
  report.dish_index = identify_dish(workspace, configuration, rim.plane, report.rim_height_mm);
  if (report.dish_index < 0) {
    return judge_unknown_dish(pair, pictures.depth_mm, rim.plane, configuration, workspace);
  }
  const DishModel& dish = configuration.dishes[static_cast<std::size_t>(report.dish_index)];
  views.table = table.table;
  views.dish_bottom =
      place_dish_bottom(dish_input, configuration.dish, report.rim_height_mm, dish.bottom_height_mm);
  return StatusCode::ok;
}

Status extract_volumes(const ReferencePair& pair, const Configuration& configuration,
                       VolumeExtractionWorkspace& workspace, StageClock& clock, WorkingPictures& pictures,
                       MeasurementViews& views) {
  Status status =
      build_food_mesh(pictures.depth_mm, pair.reference->working_labels, pair.reference->cutout.camera,
                      configuration.mesh, workspace.mesh, pictures.mesh);
  if (!status.ok()) return status;
  clock.enter(Stage::volume);
  status = integrate_volume(pictures.mesh, views.dish_bottom, configuration.volume, workspace.volume);
  if (!status.ok()) return status;
  workspace.items.clear();
  for (int value = kFirstItemLabel; value <= kLastItemLabel; ++value) {
    const auto label = static_cast<std::uint8_t>(value);
    if (pair.reference->regions.pixels[label] == 0 && pair.other->regions.pixels[label] == 0) continue;
    const ItemVolume& volume = workspace.volume.items[label];
    ItemResult item;
    item.label = label;
    item.status = judge_item(label, pair, pictures.mesh, volume, configuration);
    item.volume_ml = item.column_volume_ml = volume.volume_ml;
    item.area_mm2 = volume.area_mm2;
    item.mean_height_mm = volume.mean_height_mm;
    item.max_height_mm = volume.max_height_mm;
    workspace.items.push_back(item);
  }
  return summarise(workspace.items.items());
}

}  // namespace traygauge::paper
