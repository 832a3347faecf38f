#include "core/pipeline/scene_geometry.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/median.hpp"
#include "core/base/units.hpp"
#include "core/card/card.hpp"
#include "core/dish/dish_outline.hpp"

namespace traygauge {
namespace {

std::span<const DishModel> candidates_for(std::uint8_t label, std::span<const DishModel> dishes) {
  const auto has_label = [&](const DishModel& dish) { return dish.label == label; };
  const auto first = std::find_if(dishes.begin(), dishes.end(), has_label);
  const auto last = std::find_if_not(first, dishes.end(), has_label);
  return {first, last};
}

bool is_seen(const ViewPair& views, std::uint8_t label) {
  return views[0]->regions().pixels[label] > 0 || views[1]->regions().pixels[label] > 0;
}

// In either picture the middle of the item's box lies in the ellipse that fills the dish's; or the item hides
// most of the dish: a pizza leaves a crescent of its plate.
bool is_amid(const ViewPair& views, std::uint8_t item, std::uint8_t dish) {
  return std::ranges::any_of(views, [&](const TrayView* view) {
    const PixelBox& inner = view->regions().boxes[item];
    const PixelBox& outer = view->regions().boxes[dish];
    if (inner.empty() || outer.empty()) return false;
    const Vec2 inner_size(inner.width(), inner.height());
    const Vec2 outer_size(outer.width(), outer.height());
    const Vec2 twice_off(inner.left + inner.right - outer.left - outer.right,
                         inner.top + inner.bottom - outer.top - outer.bottom);
    const bool do_meet = (twice_off.cwiseAbs() - inner_size - outer_size).maxCoeff() <= 0.0;
    return twice_off.cwiseQuotient(outer_size).squaredNorm() <= 1.0 ||
           (do_meet && inner_size.prod() > outer_size.prod());
  });
}

// In the frame of the dishes.
std::array<CardPrior, 2> card_priors(const ViewPair& views, const OwnMotion& motion) {
  std::array<CardPrior, 2> cards;
  for (std::size_t v = 0; v < 2; ++v)
    cards[v] = {views[v]->card().camera_from_table, views[v]->card().information};
  if (motion.is_known) cards[1] = card_in_frame_of(motion, cards[1]);
  return cards;
}

BundleInput join(const ViewPair& views, const ReferenceCard& card, const SceneGeometry& geometry,
                 std::span<const BundleDish> dishes) {
  BundleInput input;
  input.cards = card_priors(views, geometry.own_motion);
  for (std::size_t v = 0; v < 2; ++v) {
    input.focals_px[v] = views[v]->lens.pinhole.mean_focal_px();
  }
  input.card_middle_mm = print_point_mm({0.5 * card.width_mm, 0.5 * card.height_mm}, card.thickness_mm);
  input.tracks = geometry.tracks;
  input.dishes = dishes;
  return input;
}

std::span<const Vec2> seen_rim(const TrayView& view, std::uint8_t label) {
  const auto rim = std::ranges::find(view.rims, label, &SeenRim::label);
  return rim == view.rims.end() ? std::span<const Vec2>() : rim->rays.items();
}

// Into the workspace's outlines.
Status trace_outlines(const ViewPair& views, const Configuration& configuration,
                      SceneGeometryWorkspace& workspace, const SceneGeometry& geometry) {
  for (std::size_t d = 0; d < geometry.dish_count; ++d) {
    const DishRegion region{geometry.dishes[d].label, geometry.dishes[d].labels};
    for (std::size_t v = 0; v < 2; ++v) {
      workspace.outlines[d][v].clear();
      if (views[v]->regions().pixels[region.dish] == 0) continue;
      if (const std::span<const Vec2> seen = seen_rim(*views[v], region.dish); !seen.empty()) {
        workspace.outlines[d][v].assign(seen);
        continue;
      }
      const Status status =
          trace_dish_outline(views[v]->labels, views[v]->lens, region, configuration.outline,
                             workspace.outline, workspace.outlines[d][v]);
      if (!status.ok()) return status;
    }
  }
  return StatusCode::ok;
}

}  // namespace

Status list_dishes(const ViewPair& views, const Configuration& configuration,
                   SceneGeometryWorkspace& workspace, SceneGeometry& geometry) {
  geometry.dish_count = 0;
  for (int value = kDishLabel; value <= kLastFurtherDishLabel; ++value) {
    const auto label = static_cast<std::uint8_t>(value);
    if (!is_dish(label) || !is_seen(views, label)) continue;
    if (geometry.dish_count == kMaxPlacedDishes) return StatusCode::too_many_dishes;
    DishOnTray& dish = geometry.dishes[geometry.dish_count++];
    dish = {label, {}, candidates_for(label, configuration.dishes), {}};
    dish.labels.add(label);
    if (dish.candidates.empty()) return StatusCode::dish_unknown;
  }
  if (geometry.dish_count == 0) return StatusCode::no_dish_label;
  const std::array<ImageView<const std::uint8_t>, 2> labels = {views[0]->labels, views[1]->labels};
  const DishOfItem owners = find_dishes_of_items(labels, configuration.membership, workspace.borders);
  const std::span<DishOnTray> dishes = std::span(geometry.dishes).first(geometry.dish_count);
  for (int value = kFirstItemLabel; value <= kLastItemLabel; ++value) {
    const auto label = static_cast<std::uint8_t>(value);
    if (!is_seen(views, label)) continue;
    const auto around = std::ranges::find_if(
        dishes, [&](const DishOnTray& dish) { return is_amid(views, label, dish.label); });
    const bool is_amid_one = around != dishes.end();
    if (!is_amid_one && lies_apart(label, configuration.membership, workspace.borders)) {
      geometry.beside_dishes.add(label);
      continue;
    }
    const std::uint8_t owner =
        owners[label] == kBackgroundLabel && is_amid_one ? around->label : owners[label];
    for (DishOnTray& dish : dishes) {
      if (dish.label == owner || geometry.dish_count == 1) dish.labels.add(label);
    }
  }
  return StatusCode::ok;
}

Status find_geometry(const ViewPair& views, const Configuration& configuration, Random& random,
                     SceneGeometryWorkspace& workspace, StageClock& clock, MeasurementReport& report,
                     SceneGeometry& geometry) {
  clock.enter(Stage::pose);
  Status status = trace_outlines(views, configuration, workspace, geometry);
  if (!status.ok()) return status;
  clock.enter(Stage::matching);
  const TrackedView first{views[0]->gray, views[0]->labels, views[0]->lens};
  const TrackedView second{views[1]->gray, views[1]->labels, views[1]->lens};
  PointTrackingReport tracking;
  PointTrackingParams params = configuration.tracking;
  const std::array<CardPrior, 2> cards = card_priors(views, geometry.own_motion);
  if (geometry.own_motion.is_known) {
    params.follows_table = false;
    params.correction.turn_sigma_deg =
        std::max(params.correction.turn_sigma_deg, geometry.own_motion.turn_sigma_rad / kRadiansPerDegree);
  }
  status = track_points(first, second, {cards[0].camera_from_table, cards[1].camera_from_table},
                        configuration.card.thickness_mm, params, random, workspace.tracking, geometry.tracks,
                        tracking);
  report.corners = static_cast<int>(tracking.corners);
  report.matches = static_cast<int>(tracking.tracks);
  geometry.strays = tracking.strays;
  if (!status.ok()) return status;

  clock.enter(Stage::pose);
  status = refine_geometry(views, configuration.card, configuration.bundle, workspace, geometry);
  report.inliers = geometry.bundle.lines.inliers;
  report.inlier_threshold_px = kOutlierSigmas * geometry.bundle.lines.rms;
  report.pose_iterations = geometry.bundle.iterations;
  report.rim_points = geometry.bundle.rims.inliers;
  return status;
}

Status refine_geometry(const ViewPair& views, const ReferenceCard& card, const BundleParams& params,
                       SceneGeometryWorkspace& workspace, SceneGeometry& geometry) {
  std::array<BundleDish, kMaxPlacedDishes> dishes;
  for (std::size_t d = 0; d < geometry.dish_count; ++d) {
    dishes[d] = {{workspace.outlines[d][0].items(), workspace.outlines[d][1].items()},
                 geometry.dishes[d].candidates};
  }
  return adjust_bundle(join(views, card, geometry, std::span(dishes).first(geometry.dish_count)), params,
                       workspace.bundle, geometry.bundle);
}

}  // namespace traygauge
