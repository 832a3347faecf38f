#include "core/pose/joint_refinement.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/segmentation/label_regions.hpp"

namespace traygauge {
namespace {

constexpr double kMedianToSigma = 1.4826;  // of normal errors
constexpr int kNoiseRounds = 4;
constexpr double kNoiseReach = 3.0;       // sigmas within which tracks tell the noise
constexpr double kMinTableSpread = 0.3;   // smoother than this the table is not taken for
constexpr double kInitialDamping = 1e-8;  // the card alone is near enough for Gauss and Newton's steps
// Relative decrease of the cost that is worth another iteration: before the next round weighs anew, and last.
constexpr double kMinImprovement = 1e-2;
constexpr double kMinLastImprovement = 1e-5;

double information(double sigma) {
  return 1.0 / (sigma * sigma);
}

bool is_on_a_dish(std::uint8_t label) {
  return label != kBackgroundLabel && label != kCardLabel;
}

// A residual's variance from what is not known of the cameras.
template <int kSize>
double predicted_variance(const Eigen::Matrix<double, kSize, kSize>& covariance,
                          const Eigen::Matrix<double, kSize, 1>& jacobian) {
  return jacobian.dot(covariance * jacobian);
}

class JointRefinement {
 public:
  JointRefinement(const JointInput& input, const JointParams& params, JointWorkspace& workspace,
                  JointResult& result)
      : input_(input), params_(params), workspace_(workspace), result_(result) {
    terms_.cards = input.cards;
    terms_.card_pivot_mm = input.card_middle_mm;
    terms_.lie_tilt_information = information(params.card_tilt_sigma_deg * std::numbers::pi / 180.0);
    terms_.lie_raised_information = information(params.card_raised_sigma_mm);
    terms_.focals_px = input.focals_px;
    if (params.use_tracks) {
      terms_.tracks = input.tracks.first(std::min(input.tracks.size(), workspace.weights.size()));
      terms_.weights = workspace.weights.first(terms_.tracks.size());
    }
    for (std::size_t view = 0; view < 2; ++view)
      state_.camera_from_table[view] = input.cards[view].camera_from_table;
  }

  Status run() {
    std::fill(workspace_.weights.begin(), workspace_.weights.end(), TrackWeight{});
    if (!update_covariance()) return StatusCode::card_not_found;
    // Dish and card rest on the tray together; the background may not.
    const bool is_dish_first = count_dish_tracks() >= params_.min_dish_tracks;
    for (const Trust trust :
         {is_dish_first ? Trust::dishes : Trust::all, Trust::lines, Trust::consensus, Trust::table}) {
      weigh_tracks(trust);
      const JointState before = state_;
      if (trust == Trust::consensus && params_.use_table) find_table_tracks();
      improve(trust == Trust::table ? kMinLastImprovement : kMinImprovement);
      if (is_table_found_ && !is_card_plausible()) {
        is_table_found_ = false;
        state_ = before;
        weigh_tracks(Trust::lines);
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
  // What the tracks are taken for, round by round.
  enum class Trust : std::uint8_t {
    all,        // any for their lines
    dishes,     // those on dishes for their lines
    lines,      // those near their lines
    consensus,  // and the background that agrees about it for the table
    table,      // and all background near the table for it
  };

  int count_dish_tracks() const {
    const auto on_dish = [](const PointTrack& track) { return is_on_a_dish(track.label); };
    return static_cast<int>(std::count_if(terms_.tracks.begin(), terms_.tracks.end(), on_dish));
  }

  void improve(double min_improvement) {
    const JointProblem problem(terms_, workspace_.eliminations);
    LevenbergMarquardtParams search;
    search.max_iterations = params_.iterations;
    search.initial_damping = kInitialDamping;
    search.min_improvement = min_improvement;
    result_.iterations += minimise<kJointParameters>(problem, search, state_).iterations;
  }

  // No number of points outvotes the card's lie.
  bool is_card_plausible() const {
    const double squared_deviation =
        terms_.lie_tilt_information * state_.card.tilt_rad.squaredNorm() +
        terms_.lie_raised_information * state_.card.raised_mm * state_.card.raised_mm;
    return squared_deviation <= params_.table.max_squared_deviation;
  }

  bool update_covariance() {
    const JointProblem problem(terms_, workspace_.eliminations);
    JointProblem::Equations equations;
    const double cost = problem.linearise(state_, equations);
    result_.covariance = inverse_information<kJointParameters>(equations.hessian);
    return std::isfinite(cost) && result_.covariance.allFinite() &&
           result_.covariance.diagonal().minCoeff() > 0.0;
  }

  // Variances and robust scales from the residuals and from how well the cameras are known by now.
  void weigh_tracks(Trust trust) {
    const TrackResiduals residuals(state_.camera_from_table, input_.focals_px[1]);
    const PairMatrix covariance = pair_covariance(residuals);
    const Mat6 motion = covariance.topLeftCorner<6, 6>();
    // Once the dishes have placed the cameras, and before the background can spoil that.
    if (trust <= Trust::lines) measure_noise(residuals, motion);
    if (trust == Trust::table) measure_table_spread(residuals);
    const double noise = result_.track_noise_factor * result_.track_noise_factor;
    const double sigmas = params_.robust_sigmas * params_.robust_sigmas;
    for (std::size_t i = 0; i < terms_.tracks.size(); ++i) {
      const PointTrack& track = terms_.tracks[i];
      TrackWeight& weight = workspace_.weights[i];
      weight = {};
      if (track.label == kCardLabel) continue;  // the alignment has read these pixels already
      const double variance = noise * stated_variance(track);
      double residual = 0.0;
      double by_height = 0.0;
      Vec6 by_motion;
      PairVector by_pair;
      if (!residuals.off_line(track, residual, by_motion)) continue;
      weight.line_variance = variance;
      weight.line_squared_scale = sigmas * (variance + predicted_variance<6>(motion, by_motion));
      // However little a wrong track weighs, a thousand that agree would pull; at first, however, the card
      // may be further off than it says.
      const bool is_on_line = residual * residual <= weight.line_squared_scale;
      weight.uses_line = trust == Trust::all || (trust == Trust::dishes && is_on_a_dish(track.label)) ||
                         (trust >= Trust::lines && is_on_line);
      const bool is_table = (trust == Trust::consensus || (trust == Trust::table && is_table_found_)) &&
                            params_.use_table && track.label == kBackgroundLabel;
      if (!is_table || !is_on_line || !residuals.along_line(track, residual, by_pair, by_height)) continue;
      const double rough = params_.table_flatness_mm * by_height;
      weight.table_variance = variance + rough * rough;
      weight.table_squared_scale = sigmas * (table_spread_ * table_spread_ * weight.table_variance +
                                             predicted_variance<kPairParameters>(covariance, by_pair));
      weight.uses_table = residual * residual <= weight.table_squared_scale;
    }
  }

  PairMatrix pair_covariance(const TrackResiduals& residuals) const {
    const PairByCameras chain = residuals.by_cameras();
    const CamerasMatrix cameras = result_.covariance.topLeftCorner<kCameraParameters, kCameraParameters>();
    const PairByCameras spread = chain.lazyProduct(cameras);
    return spread.lazyProduct(chain.transpose());
  }

  // Leaves the table's weight to those tracks only that agree about it.
  void find_table_tracks() {
    const TrackResiduals residuals(state_.camera_from_table, input_.focals_px[1]);
    const Mat6 motion = pair_covariance(residuals).topLeftCorner<6, 6>();
    const Pose table_from_first = state_.camera_from_table[0].inverse();
    std::size_t count = 0;
    for (std::size_t i = 0; i < terms_.tracks.size(); ++i) {
      const TrackWeight& weight = workspace_.weights[i];
      double residual = 0.0;
      double by_height = 0.0;
      PairVector by_pair;
      if (!(weight.table_squared_scale > 0.0)) continue;  // the card may be off by more: all are asked
      if (!residuals.along_line(terms_.tracks[i], residual, by_pair, by_height)) continue;
      const double variance = weight.table_variance + predicted_variance<6>(motion, by_pair.head<6>());
      const Vec3 ray = table_from_first.rotation * terms_.tracks[i].first.homogeneous();
      const Vec2 place = (table_from_first.translation - table_from_first.translation.z() / ray.z() * ray -
                          input_.card_middle_mm)
                             .head<2>();
      workspace_.sightings[count++] = {place.x(),
                                       place.y(),
                                       -residual / by_height,
                                       std::sqrt(variance) / std::abs(by_height),
                                       static_cast<std::uint32_t>(i),
                                       false};
    }
    const std::span<TableSighting> sightings = workspace_.sightings.first(count);
    is_table_found_ = find_table(sightings, table_covariance(), params_.table);
    for (const TableSighting& sighting : sightings) {
      workspace_.weights[sighting.track].uses_table = sighting.is_table;
    }
  }

  // Of the table against z = 0: height at the card's middle and slopes.
  Mat3 table_covariance() const {
    const Pose& first = state_.camera_from_table[0];
    const Vec3 up = first.rotation.col(2);
    Eigen::Matrix<double, 3, 6> by_camera;
    const Vec3 middle = first.rotation * input_.card_middle_mm;
    by_camera << middle.cross(up).transpose(), up.transpose(),  //
        first.rotation.col(0).cross(up).transpose(), Vec3::Zero().transpose(),
        first.rotation.col(1).cross(up).transpose(), Vec3::Zero().transpose();
    const Eigen::Matrix<double, 3, 6> spread =
        by_camera.lazyProduct(result_.covariance.topLeftCorner<6, 6>());
    return spread.lazyProduct(by_camera.transpose());
  }

  double stated_variance(const PointTrack& track) const {
    const double sigma_px = std::max(params_.min_track_sigma_px, static_cast<double>(track.sigma_px));
    return sigma_px * sigma_px;
  }

  // How much larger the tracks' errors are than they state, from the median, which wrong tracks do not move
  // far.
  void measure_noise(const TrackResiduals& residuals, const Mat6& motion) {
    const bool is_dish_enough = count_dish_tracks() >= params_.min_dish_tracks;
    std::size_t count = 0;
    for (const PointTrack& track : terms_.tracks) {
      if (is_dish_enough && !is_on_a_dish(track.label)) continue;
      double residual = 0.0;
      Vec6 by_motion;
      if (track.label == kCardLabel || !residuals.off_line(track, residual, by_motion)) continue;
      const double variance = stated_variance(track) + predicted_variance<6>(motion, by_motion);
      workspace_.magnitudes[count++] = std::abs(residual) / std::sqrt(variance);
    }
    result_.track_noise_factor = 1.0;
    if (count == 0) return;
    const std::span<double> magnitudes = workspace_.magnitudes.first(count);
    std::sort(magnitudes.begin(), magnitudes.end());
    // Wrong tracks widen the median of all: again without those far outside of it.
    std::size_t near = count;
    double factor = 1.0;
    for (int round = 0; round < kNoiseRounds && near > 0; ++round) {
      factor = kMedianToSigma * magnitudes[near / 2];
      const auto end =
          std::upper_bound(magnitudes.begin(), magnitudes.end(), kNoiseReach * std::max(factor, 1.0));
      near = static_cast<std::size_t>(end - magnitudes.begin());
    }
    result_.track_noise_factor = std::clamp(factor, 1.0, params_.max_noise_factor);
  }

  // A smooth table, sharply seen: what then lies a little beside it is a tray's rim or a cloth.
  void measure_table_spread(const TrackResiduals& residuals) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < terms_.tracks.size(); ++i) {
      const TrackWeight& weight = workspace_.weights[i];
      double residual = 0.0;
      if (!weight.uses_table || !residuals.along_line(terms_.tracks[i], residual)) continue;
      workspace_.magnitudes[count++] = std::abs(residual) / std::sqrt(weight.table_variance);
    }
    table_spread_ = 1.0;
    if (count == 0) return;
    const auto middle = workspace_.magnitudes.begin() + static_cast<std::ptrdiff_t>(count / 2);
    std::nth_element(workspace_.magnitudes.begin(), middle,
                     workspace_.magnitudes.begin() + static_cast<std::ptrdiff_t>(count));
    table_spread_ = std::clamp(kMedianToSigma * *middle, kMinTableSpread, 1.0);
  }

  void place_dishes() {
    const std::size_t count = std::min(input_.dishes.size(), kMaxPlacedDishes);
    std::size_t rims = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const JointDish& dish = input_.dishes[i];
      JointDishResult& found = result_.dishes[i];
      found.status = place_dish(dish.outlines, state_.camera_from_table, input_.focals_px, dish.candidates,
                                params_.placement, workspace_.placement, found.placed);
      if (!found.status.ok()) continue;
      const DishModel& model = dish.candidates[static_cast<std::size_t>(found.placed.candidate)];
      JointRim& rim = workspace_.rims[rims];
      rim.outlines = dish.outlines;
      rim.prior = prior_of(model, found.placed.place.azimuth_rad, params_.placement);
      rim.step = outline_step(dish.outlines, params_.placement.max_view_points);
      rim.point_sigma_px = params_.placement.point_sigma_px;
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
      JointDishResult& dish = result_.dishes[i];
      if (!dish.status.ok()) continue;
      const PlaceElimination& gone = workspace_.eliminations[index];
      PlacedDish& placed = dish.placed;
      placed.place = state_.places[index++];
      dish.place_by_cameras = -gone.from_cameras;
      const Eigen::Matrix<double, kPlaceParameters, kCameraParameters> spread =
          dish.place_by_cameras.lazyProduct(cameras);
      placed.covariance = gone.covariance + spread.lazyProduct(dish.place_by_cameras.transpose());
      robust_scale_px(input_.dishes[i].outlines, state_.camera_from_table, input_.focals_px, placed.place,
                      params_.placement, workspace_.placement, placed.fit);
      result_.rims.count += placed.fit.points;
      result_.rims.inliers += placed.fit.inliers;
      result_.rims.rms += placed.fit.inliers * placed.fit.rms_px * placed.fit.rms_px;
    }
    finish(result_.rims);
  }

  bool is_contradicted() const {
    const TermReport& dish = result_.dish_lines;
    return dish.count >= params_.min_dish_tracks && dish.inliers < params_.min_dish_inlier_share * dish.count;
  }

  const JointInput& input_;
  const JointParams& params_;
  JointWorkspace& workspace_;
  JointResult& result_;
  JointTerms terms_;
  JointState state_;
  bool are_dishes_placed_ = false;
  bool is_table_found_ = false;
  double table_spread_ = 1.0;  // of the table's tracks about it, in their standard deviations
};

bool is_usable(const CardPrior& card) {
  return card.camera_from_table.rotation.allFinite() && card.camera_from_table.translation.allFinite() &&
         card.information.allFinite() && card.information.diagonal().minCoeff() > 0.0;
}

}  // namespace

Status refine_jointly(const JointInput& input, const JointParams& params, JointWorkspace& workspace,
                      JointResult& result) {
  result = {};
  if (!is_usable(input.cards[0]) || !is_usable(input.cards[1])) return StatusCode::card_not_found;
  return JointRefinement(input, params, workspace, result).run();
}

}  // namespace traygauge
