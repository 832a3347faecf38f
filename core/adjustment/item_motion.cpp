#include "core/adjustment/item_motion.hpp"

#include <algorithm>
#include <cmath>

#include "core/adjustment/track_residuals.hpp"
#include "core/base/bounded_list.hpp"
#include "core/base/median.hpp"

namespace traygauge {
namespace {

constexpr std::size_t kMaxItemTracks = 128;  // 0.3 px at 3 px a mm: their mean is sure to 0.01 mm

// Where a track has the item's motion, and what it says of it.
struct TrackSighting {
  double along_mm = 0.0;  // of the point, in the planes through both cameras
  double across_mm = 0.0;
  Vec6 by_pair = Vec6::Zero();  // derivative of the latter
};

class MotionFit {
 public:
  MotionFit(const TableCameras& camera_from_table, double focal_px)
      : cameras_(camera_from_table),
        focal_px_(focal_px),
        second_from_first_(second_from_first(camera_from_table)),
        essential_(essential_matrix(second_from_first_)),
        residuals_(camera_from_table, focal_px),
        sightings_(storage_) {}

  void add(const PointTrack& track) {
    TrackSighting sighting;
    double residual_px = 0.0;
    Vec3 point_mm;
    if (sightings_.full() || !triangulate_track(track, cameras_[0], second_from_first_, point_mm)) return;
    if (!residuals_.off_line(track, residual_px, sighting.by_pair)) return;
    const Vec2 by_shift = by_shift_px(track, point_mm);
    const double px_per_mm = by_shift.norm();
    if (!(px_per_mm > 0.0)) return;
    const Vec2 across = by_shift / px_per_mm;
    sighting.across_mm = residual_px / px_per_mm;
    sighting.along_mm = across.x() * point_mm.y() - across.y() * point_mm.x();
    sighting.by_pair /= px_per_mm;
    sightings_.push_back(sighting);
  }

  ItemMotion solve(const CamerasMatrix& covariance, const ItemMotionParams& params) {
    ItemMotion motion;
    const std::size_t count = sightings_.size();
    if (count < static_cast<std::size_t>(params.min_tracks)) return motion;
    start();
    for (const double scale_mm : params.scales_mm) improve(scale_mm);
    double squares = 0.0;
    Vec6 by_pair = Vec6::Zero();
    std::size_t agreeing = 0;
    for (const TrackSighting& sighting : sightings_) {
      const double off_mm = std::abs(sighting.across_mm - at(sighting));
      if (off_mm > 2.0 * params.scales_mm.back()) continue;
      squares += at(sighting) * at(sighting);
      by_pair += sighting.by_pair;
      magnitudes_[agreeing++] = off_mm;
    }
    motion.is_known = agreeing >= static_cast<std::size_t>(params.min_tracks) &&
                      static_cast<double>(agreeing) >= params.min_agreeing * static_cast<double>(count);
    if (!motion.is_known) return motion;
    const auto tracks = static_cast<double>(agreeing);
    const double noise_mm =
        std::max(params.min_noise_mm, kMedianToSigma * median(std::span(magnitudes_).first(agreeing)));
    by_pair /= tracks;
    const PairByCameras chain = residuals_.by_cameras();
    const Eigen::Matrix<double, 1, kCameraParameters> by_cameras =
        by_pair.transpose().lazyProduct(chain.topRows<kPoseParameters>());
    const Eigen::Matrix<double, 1, kCameraParameters> spread = by_cameras.lazyProduct(covariance);
    motion.across_mm = std::sqrt(squares / tracks);
    // Two numbers were fitted, shift and turn.
    motion.sigma_mm = std::sqrt(2.0 * noise_mm * noise_mm / tracks + spread.dot(by_cameras));
    return motion;
  }

 private:
  double at(const TrackSighting& sighting) const {
    return shift_mm_ + turn_rad_ * (sighting.along_mm - middle_mm_);
  }

  // What a millimetre over the table along each axis moves the point off its line in the second picture.
  Vec2 by_shift_px(const PointTrack& track, const Vec3& point_mm) const {
    const Vec3 line = essential_ * track.first.homogeneous();
    const Vec3 seen = cameras_[1] * point_mm;
    const Vec2 place = seen.hnormalized();
    const Vec3 by_point = Vec3(line.x(), line.y(), -line.head<2>().dot(place)) / seen.z();
    const Vec3 by_table = cameras_[1].rotation.transpose() * by_point;
    return focal_px_ / line.head<2>().norm() * by_table.head<2>();
  }

  // Where most tracks are, whatever else was taken for them.
  void start() {
    for (std::size_t i = 0; i < sightings_.size(); ++i) magnitudes_[i] = sightings_[i].across_mm;
    shift_mm_ = median(std::span(magnitudes_).first(sightings_.size()));
    for (std::size_t i = 0; i < sightings_.size(); ++i) magnitudes_[i] = sightings_[i].along_mm;
    middle_mm_ = median(std::span(magnitudes_).first(sightings_.size()));
  }

  // Weighted least squares with Geman and McClure's weights.
  void improve(double scale_mm) {
    // rad. Tracks in one spot tell no turn: this holds it near none.
    constexpr double kTurnSigma = 0.2;
    double weights = 0.0;
    double levers = 0.0;
    double squared_levers = scale_mm * scale_mm / (kTurnSigma * kTurnSigma);
    double shifts = 0.0;
    double moments = 0.0;
    for (const TrackSighting& sighting : sightings_) {
      const double ratio = (sighting.across_mm - at(sighting)) / scale_mm;
      const double root = 1.0 / (1.0 + ratio * ratio);
      const double weight = root * root;
      const double lever_mm = sighting.along_mm - middle_mm_;
      weights += weight;
      levers += weight * lever_mm;
      squared_levers += weight * lever_mm * lever_mm;
      shifts += weight * sighting.across_mm;
      moments += weight * lever_mm * sighting.across_mm;
    }
    const double determinant = weights * squared_levers - levers * levers;
    if (!(determinant > 0.0)) return;
    shift_mm_ = (squared_levers * shifts - levers * moments) / determinant;
    turn_rad_ = (weights * moments - levers * shifts) / determinant;
  }

  const TableCameras& cameras_;
  double focal_px_;
  Pose second_from_first_;
  Mat3 essential_;
  TrackResiduals residuals_;
  std::array<TrackSighting, kMaxItemTracks> storage_;
  std::array<double, kMaxItemTracks> magnitudes_{};
  BoundedList<TrackSighting> sightings_;
  double middle_mm_ = 0.0;
  double shift_mm_ = 0.0;
  double turn_rad_ = 0.0;
};

}  // namespace

ItemMotion find_item_motion(std::uint8_t label, const std::array<std::span<const PointTrack>, 2>& tracks,
                            const TableCameras& camera_from_table, const CamerasMatrix& covariance,
                            double focal_px, const ItemMotionParams& params) {
  MotionFit fit(camera_from_table, focal_px);
  for (const std::span<const PointTrack>& some : tracks) {
    for (const PointTrack& track : some) {
      if (track.label == label) fit.add(track);
    }
  }
  return fit.solve(covariance, params);
}

}  // namespace traygauge
