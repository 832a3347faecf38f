// How far an item moved by itself between the pictures: across the planes through both cameras, where what
// stands still has its points. Along these planes a motion looks like another height, which is not seen here.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/geometry/geometry.hpp"
#include "core/geometry/table_frame.hpp"
#include "core/tracking/point_track.hpp"

namespace traygauge {

// Set by reason and tried on slips-10 of seed 71; seed 81 had no say (tests/evaluation/experiments.md).
struct ItemMotionParams {
  int min_tracks = 4;         // two more than the fit has unknowns
  double min_agreeing = 0.5;  // of the tracks: more may be wrong than right else
  // A track so far off the item's motion counts a quarter: at first they may be anywhere, at last a few of
  // their errors off.
  std::array<double, 5> scales_mm = {4.0, 2.0, 1.0, 0.5, 0.5};
  double min_noise_mm = 0.05;  // of a track: 0.15 px at 3 px a mm
};

// Over the table, of an item that moved and turned as a whole.
struct ItemMotion {
  bool is_known = false;   // enough of its tracks agree about it
  double across_mm = 0.0;  // root mean square over its tracks
  double sigma_mm = 0.0;
};

// The tracks of `label` among all that there are, also those that contradict the cameras. `covariance` is
// that of a step of both cameras, the first one first; `focal_px` the second one's.
ItemMotion find_item_motion(std::uint8_t label, const std::array<std::span<const PointTrack>, 2>& tracks,
                            const TableCameras& camera_from_table, const CamerasMatrix& covariance,
                            double focal_px, const ItemMotionParams& params);

}  // namespace traygauge
