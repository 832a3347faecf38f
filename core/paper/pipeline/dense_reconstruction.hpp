// Dense reconstruction (paper III-B): rectification → stereo → depth map of the reference view.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/base/arena.hpp"
#include "core/base/status.hpp"
#include "core/geometry/triangulation.hpp"
#include "core/paper/pipeline/configuration.hpp"
#include "core/paper/pipeline/view_preparation.hpp"
#include "core/paper/pipeline/working_pictures.hpp"
#include "core/paper/pose/relative_pose.hpp"
#include "core/paper/rectification/polar_rectification.hpp"
#include "core/paper/stereo/stereo.hpp"
#include "core/pipeline/measurement.hpp"
#include "core/pipeline/stage_clock.hpp"

namespace traygauge::paper {

// The two views with the reference first, whichever was taken first.
struct ReferencePair {
  const PreparedView* reference = nullptr;
  const PreparedView* other = nullptr;
  Pose other_from_reference;          // mm
  std::span<const RayMatch> matches;  // inliers, reference first

  CameraPair cameras() const {
    return {reference->cutout.camera, other->cutout.camera, other_from_reference};
  }
};

struct DenseWorkspace {
  std::array<std::span<std::uint8_t>, 2> regions;  // working pictures: non-zero on the dish
  RectificationWorkspace rectification;
  std::array<std::span<std::uint8_t>, 2> rectified_gray;
  std::array<std::span<std::uint8_t>, 2> rectified_region;
  std::span<double> match_disparities;
  StereoWorkspace stereo;
  std::span<Disparity> disparity;
  std::span<float> depth_mm;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, const Configuration& configuration) {
    const Caps& caps = configuration.caps;
    const RectificationParams& rectified_caps = configuration.rectification;
    const auto working = static_cast<std::size_t>(caps.max_working_px);
    const auto rectified = static_cast<std::size_t>(rectified_caps.max_rows) *
                           static_cast<std::size_t>(rectified_caps.max_columns);
    for (auto& region : regions) region = arena.template take<std::uint8_t>(working);
    rectification.allocate(arena, rectified_caps);
    for (auto& picture : rectified_gray) picture = arena.template take<std::uint8_t>(rectified);
    for (auto& picture : rectified_region) picture = arena.template take<std::uint8_t>(rectified);
    match_disparities = arena.template take<double>(static_cast<std::size_t>(caps.max_keypoints));
    stereo.allocate(arena, rectified_caps.max_columns, rectified_caps.max_rows,
                    configuration.disparity_range.max_count, configuration.stereo);
    disparity = arena.template take<Disparity>(rectified);
    depth_mm = arena.template take<float>(working);
  }
};

// Fills rectified, disparity, depth_mm of `pictures` and the dense part of the report.
Status reconstruct_dense(const ReferencePair& pair, const Configuration& configuration,
                         DenseWorkspace& workspace, StageClock& clock, MeasurementReport& report,
                         WorkingPictures& pictures);

}  // namespace traygauge::paper
