#include "core/adjustment/track_weighing.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/median.hpp"

namespace traygauge {
namespace {

constexpr double kMinTableSpread = 0.3;  // smoother than this the table is not taken for

// A residual's variance from what is not known of the cameras.
template <int kSize>
double predicted_variance(const Eigen::Matrix<double, kSize, kSize>& covariance,
                          const Eigen::Matrix<double, kSize, 1>& jacobian) {
  return jacobian.dot(covariance * jacobian);
}

PairMatrix pair_covariance(const TrackResiduals& residuals, const BundleMatrix& covariance) {
  const PairByCameras chain = residuals.by_cameras();
  const CamerasMatrix cameras = covariance.topLeftCorner<kCameraParameters, kCameraParameters>();
  const PairByCameras spread = chain.lazyProduct(cameras);
  return spread.lazyProduct(chain.transpose());
}

// Of the table against z = 0: height at the card's middle and slopes.
Mat3 table_covariance(const Pose& first, const Vec3& card_middle_mm, const BundleMatrix& covariance) {
  const Vec3 up = first.rotation.col(2);
  Eigen::Matrix<double, 3, 6> by_camera;
  const Vec3 middle = first.rotation * card_middle_mm;
  by_camera << middle.cross(up).transpose(), up.transpose(),  //
      first.rotation.col(0).cross(up).transpose(), Vec3::Zero().transpose(),
      first.rotation.col(1).cross(up).transpose(), Vec3::Zero().transpose();
  const Eigen::Matrix<double, 3, 6> spread = by_camera.lazyProduct(covariance.topLeftCorner<6, 6>());
  return spread.lazyProduct(by_camera.transpose());
}

}  // namespace

bool TrackWeighing::has_enough_on_dishes() const {
  const auto on_dish = [](const PointTrack& track) { return is_on_a_dish(track.label); };
  return std::count_if(tracks_.begin(), tracks_.end(), on_dish) >= kMinTracks;
}

double TrackWeighing::stated_variance(const PointTrack& track) const {
  const double sigma_px = std::max(params_.min_track_sigma_px, static_cast<double>(track.sigma_px));
  return sigma_px * sigma_px;
}

void TrackWeighing::weigh(const TableCameras& camera_from_table, const BundleMatrix& covariance,
                          TrackTrust trust) {
  const TrackResiduals residuals(camera_from_table, input_.focals_px[1]);
  const PairMatrix pair = pair_covariance(residuals, covariance);
  const Mat6 motion = pair.topLeftCorner<6, 6>();
  // Once the dishes have placed the cameras, and before the background can spoil that.
  if (trust <= TrackTrust::lines) measure_noise(residuals, motion);
  if (trust == TrackTrust::table) measure_table_spread(residuals);
  const double noise = noise_factor_ * noise_factor_;
  const double sigmas = kOutlierSigmas * kOutlierSigmas;  // of Geman and McClure's scale
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    const PointTrack& track = tracks_[i];
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
    weight.uses_line = trust == TrackTrust::all ||
                       (trust == TrackTrust::dishes && is_on_a_dish(track.label)) ||
                       (trust >= TrackTrust::lines && is_on_line);
    const bool is_table =
        (trust == TrackTrust::consensus || (trust == TrackTrust::table && is_table_found_)) &&
        params_.use_table && track.label == kBackgroundLabel;
    if (!is_table || !is_on_line || !residuals.along_line(track, residual, by_pair, by_height)) continue;
    const double rough = params_.table_flatness_mm * by_height;
    weight.table_variance = variance + rough * rough;
    weight.table_squared_scale = sigmas * (table_spread_ * table_spread_ * weight.table_variance +
                                           predicted_variance<kPairParameters>(pair, by_pair));
    weight.uses_table = residual * residual <= weight.table_squared_scale;
  }
}

void TrackWeighing::find_table_tracks(const TableCameras& camera_from_table, const BundleMatrix& covariance) {
  const TrackResiduals residuals(camera_from_table, input_.focals_px[1]);
  const Mat6 motion = pair_covariance(residuals, covariance).topLeftCorner<6, 6>();
  const Pose table_from_first = camera_from_table[0].inverse();
  std::size_t count = 0;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    const TrackWeight& weight = workspace_.weights[i];
    double residual = 0.0;
    double by_height = 0.0;
    PairVector by_pair;
    if (!(weight.table_squared_scale > 0.0)) continue;  // the card may be off by more: all are asked
    if (!residuals.along_line(tracks_[i], residual, by_pair, by_height)) continue;
    const double variance = weight.table_variance + predicted_variance<6>(motion, by_pair.head<6>());
    const Vec3 ray = table_from_first.rotation * tracks_[i].first.homogeneous();
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
  const Mat3 prior = table_covariance(camera_from_table[0], input_.card_middle_mm, covariance);
  is_table_found_ = find_table(sightings, prior, params_.table);
  for (const TableSighting& sighting : sightings) {
    workspace_.weights[sighting.track].uses_table = sighting.is_table;
  }
}

// How much larger the tracks' errors are than they state, from the median, which wrong tracks do not move
// far.
void TrackWeighing::measure_noise(const TrackResiduals& residuals, const Mat6& motion) {
  const bool is_dish_enough = has_enough_on_dishes();
  std::size_t count = 0;
  for (const PointTrack& track : tracks_) {
    if (is_dish_enough && !is_on_a_dish(track.label)) continue;
    double residual = 0.0;
    Vec6 by_motion;
    if (track.label == kCardLabel || !residuals.off_line(track, residual, by_motion)) continue;
    const double variance = stated_variance(track) + predicted_variance<6>(motion, by_motion);
    workspace_.magnitudes[count++] = std::abs(residual) / std::sqrt(variance);
  }
  noise_factor_ = 1.0;
  if (count == 0) return;
  const std::span<double> magnitudes = workspace_.magnitudes.first(count);
  std::sort(magnitudes.begin(), magnitudes.end());
  // Wrong tracks widen the median of all: again without those far outside of it.
  std::size_t near = count;
  double factor = 1.0;
  for (int round = 0; round < kSettlingRounds && near > 0; ++round) {
    factor = kMedianToSigma * magnitudes[near / 2];
    const auto end =
        std::upper_bound(magnitudes.begin(), magnitudes.end(), kOutlierSigmas * std::max(factor, 1.0));
    near = static_cast<std::size_t>(end - magnitudes.begin());
  }
  noise_factor_ = std::clamp(factor, 1.0, params_.max_noise_factor);
}

// A smooth table, sharply seen: what then lies a little beside it is a tray's rim or a cloth.
void TrackWeighing::measure_table_spread(const TrackResiduals& residuals) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    const TrackWeight& weight = workspace_.weights[i];
    double residual = 0.0;
    if (!weight.uses_table || !residuals.along_line(tracks_[i], residual)) continue;
    workspace_.magnitudes[count++] = std::abs(residual) / std::sqrt(weight.table_variance);
  }
  table_spread_ = 1.0;
  if (count == 0) return;
  const double middle = median(std::span(workspace_.magnitudes).first(count));
  table_spread_ = std::clamp(kMedianToSigma * middle, kMinTableSpread, 1.0);
}

}  // namespace traygauge
