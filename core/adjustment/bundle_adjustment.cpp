#include "core/adjustment/bundle_adjustment.hpp"

#include <algorithm>
#include <cmath>

#include "core/adjustment/track_weighing.hpp"
#include "core/base/units.hpp"

namespace traygauge {
namespace {

constexpr double kInitialDamping = 1e-8;  // the card alone is near enough for Gauss and Newton's steps
// Relative decrease of the cost that is worth another iteration: before the next round weighs anew, and last.
// Neither matters within a factor of two (tests/evaluation/numbers.tsv).
constexpr double kMinRoundImprovement = 1e-2;
constexpr double kMinLastImprovement = 1e-5;

double information_of(double sigma) {
  return 1.0 / (sigma * sigma);
}

// As many as memory is there for.
std::span<const PointTrack> used_tracks(const BundleInput& input, const BundleParams& params,
                                        const BundleWorkspace& workspace) {
  return input.tracks.first(params.use_tracks ? std::min(input.tracks.size(), workspace.weights.size()) : 0);
}

class BundleAdjustment {
 public:
  BundleAdjustment(const BundleInput& input, const BundleParams& params, BundleWorkspace& workspace,
                   BundleResult& result)
      : input_(input),
        params_(params),
        workspace_(workspace),
        result_(result),
        tracks_(input, used_tracks(input, params, workspace), params, workspace) {
    terms_.cards = input.cards;
    terms_.card_pivot_mm = input.card_middle_mm;
    terms_.lie_tilt_information = information_of(params.card_tilt_sigma_deg * kRadiansPerDegree);
    terms_.lie_raised_information = information_of(params.card_raised_sigma_mm);
    terms_.focals_px = input.focals_px;
    terms_.tracks = used_tracks(input, params, workspace);
    terms_.weights = workspace.weights.first(terms_.tracks.size());
    for (std::size_t view = 0; view < 2; ++view)
      state_.camera_from_table[view] = input.cards[view].camera_from_table;
  }

  Status run() {
    std::fill(workspace_.weights.begin(), workspace_.weights.end(), TrackWeight{});
    if (!update_covariance()) return StatusCode::card_not_found;
    // Dish and card rest on the tray together; the background may not.
    const TrackTrust first = tracks_.has_enough_on_dishes() ? TrackTrust::dishes : TrackTrust::all;
    for (const TrackTrust trust : {first, TrackTrust::lines, TrackTrust::consensus, TrackTrust::table}) {
      tracks_.weigh(state_.camera_from_table, result_.covariance, trust);
      const BundleState before = state_;
      if (trust == TrackTrust::consensus && params_.use_table)
        tracks_.find_table_tracks(state_.camera_from_table, result_.covariance);
      improve(trust == TrackTrust::table ? kMinLastImprovement : kMinRoundImprovement);
      if (tracks_.is_table_found() && !is_card_plausible()) {
        tracks_.drop_table();
        state_ = before;
        tracks_.weigh(state_.camera_from_table, result_.covariance, TrackTrust::lines);
        improve(kMinLastImprovement);
      }
      // The rims tell the table's slope before its texture is asked.
      if (params_.use_rims && !are_dishes_placed_) place_dishes();
      if (!update_covariance()) return StatusCode::pose_not_found;
    }
    report();
    return is_contradicted() ? StatusCode::pose_contradicts_card : StatusCode::ok;
  }

 private:
  void improve(double min_improvement) {
    const BundleProblem problem(terms_, workspace_.eliminations);
    LevenbergMarquardtParams search;
    search.max_iterations = params_.iterations;
    search.initial_damping = kInitialDamping;
    search.min_improvement = min_improvement;
    result_.iterations += minimise<kBundleParameters>(problem, search, state_).iterations;
  }

  // No number of points outvotes the card's lie.
  bool is_card_plausible() const {
    const double squared_deviation =
        terms_.lie_tilt_information * state_.card.tilt_rad.squaredNorm() +
        terms_.lie_raised_information * state_.card.raised_mm * state_.card.raised_mm;
    return squared_deviation <= params_.table.max_squared_deviation;
  }

  bool update_covariance() {
    const BundleProblem problem(terms_, workspace_.eliminations);
    BundleProblem::Equations equations;
    const double cost = problem.linearise(state_, equations);
    result_.covariance = inverse_information<kBundleParameters>(equations.hessian);
    return std::isfinite(cost) && result_.covariance.allFinite() &&
           result_.covariance.diagonal().minCoeff() > 0.0;
  }

  void place_dishes() {
    const std::size_t count = std::min(input_.dishes.size(), kMaxPlacedDishes);
    std::size_t rims = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const BundleDish& dish = input_.dishes[i];
      BundleDishResult& found = result_.dishes[i];
      found.status = fit_dish_pose(dish.outlines, state_.camera_from_table, input_.focals_px, dish.candidates,
                                   params_.placement, workspace_.placement, found.placed);
      if (!found.status.ok()) continue;
      const DishModel& model = dish.candidates[static_cast<std::size_t>(found.placed.candidate)];
      BundleRim& rim = workspace_.rims[rims];
      rim.outlines = dish.outlines;
      rim.prior = prior_of(model, found.placed.place.azimuth_rad, params_.placement);
      rim.step = outline_step(dish.outlines, params_.placement.max_view_points);
      rim.scale_px =
          robust_scale_px(dish.outlines, state_.camera_from_table, input_.focals_px, found.placed.place,
                          params_.placement, workspace_.placement, found.placed.fit);
      state_.places[rims++] = found.placed.place;
    }
    terms_.rims = workspace_.rims.first(rims);
    are_dishes_placed_ = true;
  }

  void report() {
    result_.camera_from_table = state_.camera_from_table;
    result_.card = state_.card;
    report_cards();
    report_tracks();
    report_dishes();
  }

  void report_cards() {
    const Pose table_from_card = state_.card.table_from_card(input_.card_middle_mm);
    double squares = 0.0;
    for (std::size_t view = 0; view < 2; ++view) {
      const Vec6 deviation =
          card_deviation(input_.cards[view], state_.camera_from_table[view] * table_from_card);
      squares += deviation.dot(input_.cards[view].information * deviation);
    }
    result_.cards = {kCameraParameters, kCameraParameters, std::sqrt(squares / kCameraParameters)};
  }

  void report_tracks() {
    result_.track_noise_factor = tracks_.noise_factor();
    const TrackResiduals residuals(state_.camera_from_table, input_.focals_px[1]);
    for (std::size_t i = 0; i < terms_.tracks.size(); ++i) {
      const PointTrack& track = terms_.tracks[i];
      const TrackWeight& weight = workspace_.weights[i];
      double residual = 0.0;
      if (weight.line_squared_scale > 0.0 && residuals.off_line(track, residual)) {
        count_residual(residual, weight.line_squared_scale, result_.lines);
        if (is_on_a_dish(track.label))
          count_residual(residual, weight.line_squared_scale, result_.dish_lines);
      }
      if (weight.table_squared_scale > 0.0 && residuals.along_line(track, residual))
        count_residual(residual, weight.table_squared_scale, result_.table);
    }
    for (TermReport* term : {&result_.lines, &result_.dish_lines, &result_.table}) finish(*term);
  }

  static void count_residual(double residual, double squared_scale, TermReport& term) {
    ++term.count;
    if (residual * residual > squared_scale) return;
    ++term.inliers;
    term.rms += residual * residual;
  }
  static void finish(TermReport& term) {
    term.rms = term.inliers > 0 ? std::sqrt(term.rms / term.inliers) : 0.0;
  }

  void report_dishes() {
    const CamerasMatrix cameras = result_.covariance.topLeftCorner<kCameraParameters, kCameraParameters>();
    std::size_t index = 0;
    const std::size_t count = std::min(input_.dishes.size(), kMaxPlacedDishes);
    for (std::size_t i = 0; i < count && index < terms_.rims.size(); ++i) {
      BundleDishResult& dish = result_.dishes[i];
      if (!dish.status.ok()) continue;
      const PlaceElimination& gone = workspace_.eliminations[index];
      PlacedDish& placed = dish.placed;
      placed.place = state_.places[index++];
      dish.place_by_cameras = -gone.from_cameras;
      const Eigen::Matrix<double, kPlaceParameters, kCameraParameters> spread =
          dish.place_by_cameras.lazyProduct(cameras);
      placed.covariance = gone.covariance + spread.lazyProduct(dish.place_by_cameras.transpose());
      placed.fit = fit_of_outlines(input_.dishes[i].outlines, state_.camera_from_table, input_.focals_px,
                                   placed.place, params_.placement, workspace_.placement);
      result_.rims.count += placed.fit.points;
      result_.rims.inliers += placed.fit.inliers;
      result_.rims.rms += placed.fit.inliers * placed.fit.rms_px * placed.fit.rms_px;
    }
    finish(result_.rims);
  }

  bool is_contradicted() const {
    const TermReport& dish = result_.dish_lines;
    return dish.count >= kMinTracks && dish.inliers < params_.min_dish_inlier_fraction * dish.count;
  }

  const BundleInput& input_;
  const BundleParams& params_;
  BundleWorkspace& workspace_;
  BundleResult& result_;
  TrackWeighing tracks_;
  BundleTerms terms_;
  BundleState state_;
  bool are_dishes_placed_ = false;
};

bool is_usable(const CardPrior& card) {
  return card.camera_from_table.rotation.allFinite() && card.camera_from_table.translation.allFinite() &&
         card.information.allFinite() && card.information.diagonal().minCoeff() > 0.0;
}

}  // namespace

Status adjust_bundle(const BundleInput& input, const BundleParams& params, BundleWorkspace& workspace,
                     BundleResult& result) {
  result = {};
  if (!is_usable(input.cards[0]) || !is_usable(input.cards[1])) return StatusCode::card_not_found;
  return BundleAdjustment(input, params, workspace, result).run();
}

}  // namespace traygauge
