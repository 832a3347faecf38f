// From a frame and its labels to what the stages work on: salient points with their rays, and the dish,
// undistorted and resized to a fixed area (paper III-B-2: "the two images are first resized to a fixed dish
// size").
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/base/arena.hpp"
#include "core/base/bounded_list.hpp"
#include "core/base/status.hpp"
#include "core/geometry/camera.hpp"
#include "core/image/resample.hpp"
#include "core/image_view/image_view.hpp"
#include "core/labels/label_regions.hpp"
#include "core/paper/features/keypoint.hpp"
#include "core/paper/features/surf.hpp"
#include "core/paper/pipeline/configuration.hpp"
#include "core/quality/view_checks.hpp"

namespace traygauge::paper {

// What is kept of a view until the measurement is done.
struct PreparedView {
  LensModel lens;
  std::optional<double> arm_angle_deg;
  ImageView<const std::uint8_t> labels;  // of the stored picture, the caller's
  LabelRegions regions;
  BoundedList<Keypoint> keypoints;  // positions in the picture that was searched; `rays` say where they are
  std::span<Keypoint> keypoint_storage;
  std::span<Descriptor> descriptor_storage;
  std::span<Vec2> ray_storage;
  Roi cutout;  // the working picture's geometry
  Roi dish;    // of the part of it that holds the dish
  std::span<std::uint8_t> gray_storage;
  std::span<std::uint8_t> label_storage;
  ImageView<std::uint8_t> gray;
  ImageView<std::uint8_t> working_labels;
  std::span<ViewQuality> quality_storage;  // one
  std::size_t keypoints_found = 0;         // of which the strongest were kept

  template <class Allocator>
  constexpr void allocate(Allocator& arena, const Caps& caps) {
    const auto keypoint_count = static_cast<std::size_t>(caps.max_keypoints);
    keypoint_storage = arena.template take<Keypoint>(keypoint_count);
    keypoints = BoundedList<Keypoint>(keypoint_storage);
    descriptor_storage = arena.template take<Descriptor>(keypoint_count);
    ray_storage = arena.template take<Vec2>(keypoint_count);
    const auto pixels = static_cast<std::size_t>(caps.max_working_px);
    gray_storage = arena.template take<std::uint8_t>(pixels);
    label_storage = arena.template take<std::uint8_t>(pixels);
    quality_storage = arena.template take<ViewQuality>(1);
  }

  FeatureSet features() const {
    return {keypoints.items(), std::span<const Descriptor>(descriptor_storage).first(keypoints.size())};
  }
  const ViewQuality& quality() const { return quality_storage.front(); }
  std::span<const Vec2> rays() const { return ray_storage.first(keypoints.size()); }
};

// Scratch that is free again once the view is prepared.
struct PreparationWorkspace {
  ImageView<std::uint8_t> gray;             // memory for the largest frame
  ImageView<std::uint8_t> frame_gray;       // the current frame in it
  std::span<std::uint8_t> feature_picture;  // reduced frame, or enlarged card
  std::span<std::uint32_t> integral;
  SurfWorkspace surf;
  CardSilhouetteWorkspace card_silhouette;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, const Configuration& configuration) {
    const FrameLimits& limits = configuration.limits;
    gray = arena.template take_image<std::uint8_t>(limits.max_frame_width, limits.max_frame_height);
    const auto pixels = static_cast<std::size_t>(configuration.caps.max_feature_px);
    feature_picture = arena.template take<std::uint8_t>(pixels);
    // One more row and column than the picture; sides are at most the frame's.
    integral = arena.template take<std::uint32_t>(
        pixels + static_cast<std::size_t>(limits.max_frame_width + limits.max_frame_height + 1));
    card_silhouette.allocate(arena, limits.max_frame_height);
    surf.allocate(arena, limits.max_frame_width, configuration.surf);
  }
};

// Checks sizes, labels, exposure and the quality of the picture, and cuts the dish out.
Status prepare_picture(const FrameView& frame, const Configuration& configuration,
                       PreparationWorkspace& workspace, PreparedView& view);

}  // namespace traygauge::paper
