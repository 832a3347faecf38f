// Tracks and bundle adjustment on two photographs, as the product strings them together.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/adjustment/bundle_adjustment.hpp"
#include "core/geometry/triangulation.hpp"
#include "core/tracking/point_tracking.hpp"
#include "tests/support/allocated.hpp"
#include "tests/support/photograph_scene.hpp"

namespace traygauge::test {

class SparseStages {
 public:
  // From what is known of both cameras beforehand to where the tracks put them. The table is z = 0.
  Status run(const std::array<Photograph, 2>& photographs, const std::array<CardPrior, 2>& cards,
             const Vec3& card_middle_mm, std::uint64_t seed);

  const BundleResult& bundle() const { return joint_; }
  std::span<const PointTrack> tracks() const { return tracks_; }

 private:
  PointTrackingParams tracking_;
  Allocated<PointTrackingWorkspace> tracking_space_{1600, 1200, tracking_};
  Allocated<PyramidWorkspace> first_pyramid_{1600, 1200};
  Allocated<PyramidWorkspace> second_pyramid_{1600, 1200};
  Allocated<BundleWorkspace> joint_space_{std::size_t{2048}, std::size_t{64}};
  std::span<const PointTrack> tracks_;
  BundleResult joint_;
};

// What one pose is off from another.
struct PoseDeviation {
  double rotation_deg = 0.0;
  double direction_deg = 0.0;
  double scale_percent = 0.0;
};
PoseDeviation compare_motion(const TableCameras& found, const TableCameras& truth);

// Median distance of matches from their epipolar lines in the second view.
double median_epipolar_px(std::span<const RayMatch> matches, const TableCameras& cameras, double focal_px);

}  // namespace traygauge::test
