// How the bundle adjustment weights each point track: its variance, the scale beyond which it counts as
// wrong, and whether it tells of the epipolar line alone or also of the table.
#pragma once

#include <cstdint>
#include <span>

#include "core/adjustment/bundle_adjustment.hpp"
#include "core/geometry/geometry.hpp"
#include "core/geometry/table_frame.hpp"
#include "core/labels/label_regions.hpp"

namespace traygauge {

constexpr bool is_on_a_dish(std::uint8_t label) {
  return label != kBackgroundLabel && label != kCardLabel;
}

// What the tracks are taken for, round by round.
enum class TrackTrust : std::uint8_t {
  all,        // any for their lines
  dishes,     // those on dishes for their lines
  lines,      // those near their lines
  consensus,  // and the background that agrees about it for the table
  table,      // and all background near the table for it
};

class TrackWeighing {
 public:
  // Weights go to `workspace.weights`, one for each of `tracks`.
  TrackWeighing(const BundleInput& input, std::span<const PointTrack> tracks, const BundleParams& params,
                BundleWorkspace& workspace)
      : input_(input), tracks_(tracks), params_(params), workspace_(workspace) {}

  // Weighs all tracks anew, by their residuals and by how well the cameras are known by now.
  void weigh(const TableCameras& camera_from_table, const BundleMatrix& covariance, TrackTrust trust);
  // Leaves the table's weight to those tracks only that agree about it.
  void find_table_tracks(const TableCameras& camera_from_table, const BundleMatrix& covariance);
  void drop_table() { is_table_found_ = false; }

  bool is_table_found() const { return is_table_found_; }
  bool has_enough_on_dishes() const;
  double noise_factor() const { return noise_factor_; }  // of the tracks' errors against what they state

 private:
  double stated_variance(const PointTrack& track) const;
  void measure_noise(const TrackResiduals& residuals, const Mat6& motion);
  void measure_table_spread(const TrackResiduals& residuals);

  const BundleInput& input_;
  std::span<const PointTrack> tracks_;
  const BundleParams& params_;
  BundleWorkspace& workspace_;
  bool is_table_found_ = false;
  double noise_factor_ = 1.0;
  double table_spread_ = 1.0;  // of the table's tracks about it, in their standard deviations
};

}  // namespace traygauge
