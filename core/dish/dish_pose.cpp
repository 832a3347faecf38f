#include "core/dish/dish_pose.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/median.hpp"

namespace traygauge {
namespace {

constexpr double kLooseAzimuthSigmaRad = 0.5;   // of a measured place, 29 degrees: keeps a round one regular
constexpr double kRoundAzimuthSigmaRad = 0.01;  // of a round dish, whose azimuth means nothing

double information_at(double sigma) {
  return 1.0 / (sigma * sigma);
}

// About a described dish, as far as the choice would let another differ from it.
PlacePrior prior_of_measurement(const DishPose& described, const DishPoseParams& params) {
  return loose_prior(described, params.choice.height_tolerance_mm, params.choice.size_tolerance_mm, params);
}

int choose_candidate(std::span<const DishModel> candidates, const DishPose& measured,
                     const DishChoiceParams& params) {
  std::array<DishCandidate, kMaxDishCandidates> known{};
  const std::size_t count = std::min(candidates.size(), kMaxDishCandidates);
  for (std::size_t i = 0; i < count; ++i) {
    known[i] = {candidates[i].outer_size_mm, edge_height_mm(candidates[i])};
  }
  return choose_dish(std::span(known).first(count), measured.size_mm, measured.edge_height_mm, params);
}

// The start for a known dish: its own size, turned so that its axes lie as measured.
DishPose start_of(const DishModel& model, const DishPose& measured) {
  DishPose start = measured;
  start.size_mm = model.outer_size_mm;
  const bool is_across =
      (model.outer_size_mm[0] < model.outer_size_mm[1]) != (measured.size_mm[0] < measured.size_mm[1]);
  if (is_across) start.azimuth_rad += 0.5 * std::numbers::pi;
  const bool is_round = is_round_dish(model.outer_size_mm);
  if (is_round) start.azimuth_rad = 0.0;
  // Half a turn leaves an ellipse as it is.
  start.azimuth_rad = std::remainder(start.azimuth_rad, std::numbers::pi);
  return start;
}

// Of the points further than `scale_px` off the outline, those between the edge itself and the edge let down
// to the table.
int count_on_wall(const DishOutlines& outlines, const TableCameras& cameras, const FocalsPx& focals_px,
                  const DishPose& place, std::size_t step, double scale_px) {
  DishPose sharp = place;
  sharp.edge_drop_mm = 0.0;
  DishPose let_down = place;
  let_down.edge_drop_mm = place.edge_height_mm;
  int count = 0;
  for (std::size_t view = 0; view < 2; ++view) {
    const RimProjection outline(place, cameras[view], focals_px[view]);
    const RimProjection edge(sharp, cameras[view], focals_px[view]);
    const RimProjection foot(let_down, cameras[view], focals_px[view]);
    for (std::size_t i = 0; i < outlines[view].size(); i += step) {
      const Vec2& ray = outlines[view][i];
      double off_px = 0.0;
      double outside_px = 0.0;
      double below_px = 0.0;
      if (outline.residual(ray, off_px) && edge.residual(ray, outside_px) && foot.residual(ray, below_px))
        count += std::abs(off_px) > scale_px && outside_px >= -scale_px && below_px <= scale_px ? 1 : 0;
    }
  }
  return count;
}

class DishPoseFit {
 public:
  DishPoseFit(const DishOutlines& outlines, const TableCameras& cameras, const FocalsPx& focals_px,
              const DishPoseParams& params, DishPoseWorkspace& workspace)
      : outlines_(outlines),
        cameras_(cameras),
        focals_px_(focals_px),
        params_(params),
        workspace_(workspace),
        step_(outline_step(outlines, params.max_view_points)) {}

  Status place(std::span<const DishModel> candidates, PlacedDish& placed) {
    DishPose best;
    double best_cost = kUnseenPlace;
    for (const DishModel& model : candidates) {
      DishPose place;
      if (!guess_place(outlines_, cameras_, edge_height_mm(model), step_, workspace_, place)) continue;
      place = start_of(model, place);
      place.edge_drop_mm = params_.edge_drop_mm;
      const double cost = fit_described(model, place);
      if (!(cost < best_cost) || !as_vector(place).allFinite()) continue;
      best = place;
      best_cost = cost;
    }
    if (!(best_cost < kUnseenPlace)) return StatusCode::rim_not_found;
    placed.place = placed.measured = best;
    measure(best, placed);
    if (contradicts(outlines_, cameras_, focals_px_, placed.measured, params_, workspace_))
      return StatusCode::labels_inconsistent;
    placed.candidate = choose_candidate(candidates, placed.measured, params_.choice);
    if (placed.candidate < 0) return StatusCode::dish_unknown;
    finish(candidates[static_cast<std::size_t>(placed.candidate)], placed);
    return StatusCode::ok;
  }

 private:
  // The dish as it is described, from wide to narrow. Held at its size and height it withstands many wrong
  // points, which a freer one would stretch towards. Returns the cost at the narrow end.
  double fit_described(const DishModel& model, DishPose& place) {
    PlacePrior prior = prior_of(model, place.azimuth_rad, params_);
    prior.information.segment<3>(kPlaceHeight).setConstant(kHeldInformation);
    double cost = kUnseenPlace;
    for (const double scale_px : params_.first_robust_scales_px) cost = fit(prior, scale_px, place);
    return cost;
  }

  // What the outlines say themselves: from there, given the freedom to be another dish. A described dish that
  // does not fit leaves a large scale behind, and with it a long reach.
  void measure(const DishPose& described, PlacedDish& placed) {
    const PlacePrior prior = prior_of_measurement(described, params_);
    OutlineFit unused;
    double scale_px =
        robust_scale_px(outlines_, cameras_, focals_px_, described, params_, workspace_, unused);
    fit(prior, scale_px, placed.measured);
    scale_px =
        robust_scale_px(outlines_, cameras_, focals_px_, placed.measured, params_, workspace_, placed.fit);
    fit(prior, scale_px, placed.measured);
  }

  void finish(const DishModel& model, PlacedDish& placed) {
    placed.place = start_of(model, placed.measured);
    const PlacePrior prior = prior_of(model, placed.place.azimuth_rad, params_);
    const double scale_px =
        robust_scale_px(outlines_, cameras_, focals_px_, placed.measured, params_, workspace_, placed.fit);
    fit(prior, scale_px, placed.place);
    const DishPoseProblem problem(outlines_, cameras_, focals_px_, prior, scale_px, step_);
    NormalEquations<kPlaceParameters> equations;
    problem.linearise(placed.place, equations);
    placed.covariance = inverse_information<kPlaceParameters>(equations.hessian);
    placed.fit = fit_of_outlines(outlines_, cameras_, focals_px_, placed.place, params_, workspace_);
  }

  double fit(const PlacePrior& prior, double scale_px, DishPose& place) const {
    const DishPoseProblem problem(outlines_, cameras_, focals_px_, prior, scale_px, step_);
    return minimise<kPlaceParameters>(problem, {}, place).cost;
  }

  const DishOutlines& outlines_;
  const TableCameras& cameras_;
  const FocalsPx& focals_px_;
  const DishPoseParams& params_;
  DishPoseWorkspace& workspace_;
  std::size_t step_;
};

}  // namespace

bool guess_place(const DishOutlines& outlines, const TableCameras& cameras, double height_mm,
                 std::size_t step, DishPoseWorkspace& workspace, DishPose& place) {
  workspace.points_mm.clear();
  for (std::size_t view = 0; view < 2; ++view) {
    const Vec3 centre_mm = camera_centre_mm(cameras[view]);
    for (std::size_t i = 0; i < outlines[view].size(); i += step) {
      const Vec2& ray = outlines[view][i];
      const Vec3 direction = cameras[view].rotation.transpose() * ray.homogeneous();
      const double depth = (height_mm - centre_mm.z()) / direction.z();
      if (std::isfinite(depth) && depth > 0.0) workspace.points_mm.push_back(centre_mm + depth * direction);
    }
  }
  const Plane level{Vec3::UnitZ(), height_mm};
  const Result<RimEllipse> ellipse = fit_rim_size(workspace.points_mm.items(), level);
  if (!ellipse.ok()) return false;
  place.centre_mm = ellipse->centre_mm.head<2>();
  place.azimuth_rad = std::atan2(ellipse->axes[0].y(), ellipse->axes[0].x());
  place.edge_height_mm = height_mm;
  place.size_mm = ellipse->size_mm;
  return as_vector(place).allFinite();
}

PlacePrior loose_prior(const DishPose& place, double height_sigma_mm, double size_sigma_mm,
                       const DishPoseParams& params) {
  PlacePrior prior{as_vector(place), PlaceVector::Zero()};
  prior.information[kPlaceAzimuth] = information_at(kLooseAzimuthSigmaRad);
  prior.information[kPlaceHeight] = information_at(height_sigma_mm);
  prior.information.segment<2>(kPlaceSize).setConstant(information_at(size_sigma_mm));
  prior.information[kPlaceDrop] = information_at(params.edge_drop_mm);
  return prior;
}

bool contradicts(const DishOutlines& outlines, const TableCameras& cameras, const FocalsPx& focals_px,
                 const DishPose& place, const DishPoseParams& params, DishPoseWorkspace& workspace) {
  for (std::size_t view = 0; view < 2; ++view) {
    if (outlines[view].size() < static_cast<std::size_t>(params.min_view_points)) continue;
    DishOutlines alone;
    alone[view] = outlines[view];
    OutlineFit fit;
    robust_scale_px(alone, cameras, focals_px, place, params, workspace, fit);
    if (fit.inliers < params.min_inlier_fraction * fit.points || fit.rms_px > params.max_rms_px) return true;
  }
  return false;
}

double edge_height_mm(const DishModel& model) {
  return model.has_profile() ? model.profile_points[0].height_mm : model.rim_height_mm;
}

PlacePrior prior_of(const DishModel& model, double azimuth_rad, const DishPoseParams& params) {
  PlacePrior prior;
  prior.mean[kPlaceAzimuth] = azimuth_rad;
  const bool is_round = is_round_dish(model.outer_size_mm);
  prior.information[kPlaceAzimuth] = is_round ? information_at(kRoundAzimuthSigmaRad) : 0.0;
  prior.mean[kPlaceHeight] = edge_height_mm(model);
  prior.information[kPlaceHeight] = information_at(params.height_sigma_mm);
  prior.mean.segment<2>(kPlaceSize) = Vec2(model.outer_size_mm[0], model.outer_size_mm[1]);
  prior.information.segment<2>(kPlaceSize).setConstant(information_at(params.size_sigma_mm));
  prior.mean[kPlaceDrop] = params.edge_drop_mm;
  prior.information[kPlaceDrop] = information_at(params.edge_drop_mm);
  return prior;
}

double robust_scale_px(const DishOutlines& outlines, const TableCameras& cameras, const FocalsPx& focals_px,
                       const DishPose& place, const DishPoseParams& params, DishPoseWorkspace& workspace,
                       OutlineFit& fit) {
  const std::size_t step = outline_step(outlines, params.max_view_points);
  std::size_t count = 0;
  fit = {};
  for (std::size_t view = 0; view < 2; ++view) {
    const RimProjection rim(place, cameras[view], focals_px[view]);
    for (std::size_t i = 0; i < outlines[view].size(); i += step) {
      double residual_px = 0.0;
      ++fit.points;
      if (count < workspace.magnitudes_px.size() && rim.residual(outlines[view][i], residual_px))
        workspace.magnitudes_px[count++] = std::abs(residual_px);
    }
  }
  if (count == 0) return params.first_robust_scales_px[0];
  const std::span<double> magnitudes_px = workspace.magnitudes_px.first(count);
  std::sort(magnitudes_px.begin(), magnitudes_px.end());
  const double sigma_px = kMedianToSigma * magnitudes_px[count / 2];
  const double scale_px = std::max(std::min(kOutlierSigmas * sigma_px, params.first_robust_scales_px[0]),
                                   params.min_robust_scale_px);
  double squares = 0.0;
  for (const double magnitude_px : magnitudes_px) {
    if (magnitude_px > scale_px) break;
    squares += magnitude_px * magnitude_px;
    ++fit.inliers;
  }
  fit.rms_px = fit.inliers > 0 ? std::sqrt(squares / fit.inliers) : 0.0;
  return scale_px;
}

OutlineFit fit_of_outlines(const DishOutlines& outlines, const TableCameras& cameras,
                           const FocalsPx& focals_px, const DishPose& place, const DishPoseParams& params,
                           DishPoseWorkspace& workspace) {
  OutlineFit fit;
  const double scale_px = robust_scale_px(outlines, cameras, focals_px, place, params, workspace, fit);
  const std::size_t step = outline_step(outlines, params.max_view_points);
  fit.on_wall = count_on_wall(outlines, cameras, focals_px, place, step, scale_px);
  return fit;
}

Status fit_dish_pose(const DishOutlines& outlines, const TableCameras& cameras, const FocalsPx& focals_px,
                     std::span<const DishModel> candidates, const DishPoseParams& params,
                     DishPoseWorkspace& workspace, PlacedDish& placed) {
  placed = {};
  const std::size_t points = outlines[0].size() + outlines[1].size();
  if (points < static_cast<std::size_t>(params.min_points)) return StatusCode::rim_not_found;
  if (candidates.empty()) return StatusCode::dish_unknown;

  return DishPoseFit(outlines, cameras, focals_px, params, workspace).place(candidates, placed);
}

}  // namespace traygauge
