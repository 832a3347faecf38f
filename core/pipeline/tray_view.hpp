// One view as the estimator keeps it until the measurement is done.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "core/base/arena.hpp"
#include "core/base/status.hpp"
#include "core/card/card_alignment.hpp"
#include "core/dish/dish_outline.hpp"
#include "core/geometry/camera.hpp"
#include "core/image/gray_pyramid.hpp"
#include "core/image_view/image_view.hpp"
#include "core/labels/label_regions.hpp"
#include "core/pipeline/configuration.hpp"
#include "core/pipeline/stage_clock.hpp"
#include "core/quality/view_checks.hpp"
#include "core/stereo/surface_view.hpp"

namespace traygauge {

struct TrayView {
  LensModel lens;
  std::optional<double> arm_angle_deg;
  ImageView<const std::uint8_t> labels;    // of the stored picture, the caller's
  std::span<const SeenRim> rims;           // where dishes were found; none where a person outlined them
  std::span<LabelRegions> region_storage;  // one
  FrameView frame;                         // the caller's
  GrayPyramid gray;
  ImageView<std::uint8_t> gray_storage;     // memory for the largest frame
  ImageView<std::uint8_t> diffuse_storage;  // the same
  PyramidWorkspace pyramid;
  std::span<ViewQuality> quality_storage;  // one
  std::span<CardAlignment> card_storage;   // one

  bool are_outlines_found() const { return !rims.empty(); }
  const LabelRegions& regions() const { return region_storage.front(); }
  const ViewQuality& quality() const { return quality_storage.front(); }
  const CardAlignment& card() const { return card_storage.front(); }

  template <class Allocator>
  constexpr void allocate(Allocator& arena, const FrameLimits& limits) {
    gray_storage = arena.template take_image<std::uint8_t>(limits.max_frame_width, limits.max_frame_height);
    diffuse_storage =
        arena.template take_image<std::uint8_t>(limits.max_frame_width, limits.max_frame_height);
    pyramid.allocate(arena, limits.max_frame_width, limits.max_frame_height);
    region_storage = arena.template take<LabelRegions>(1);
    quality_storage = arena.template take<ViewQuality>(1);
    card_storage = arena.template take<CardAlignment>(1);
  }
};

using ViewPair = std::array<const TrayView*, 2>;

inline SurfaceView surface_view(const TrayView& view, const Pose& camera_from_table) {
  return {view.gray, view.lens, view.labels, camera_from_table};
}

// Scratch that is free again once the view is prepared.
struct TrayViewWorkspace {
  CardSilhouetteWorkspace silhouette;
  CardAlignmentWorkspace card;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, const Configuration& configuration) {
    silhouette.allocate(arena, configuration.limits.max_frame_height);
    card.allocate(arena, configuration.card_alignment);
  }
};

// A picture, and what a segmentation has made of it already: its grey values, with their exposure checked,
// and where its card lies.
struct GivenPicture {
  FrameView frame;
  ImageView<const std::uint8_t> gray = {};
  const CardAlignment* card = nullptr;
};

// Checks sizes, labels and exposure, makes the grey pyramid, and finds the card. `view` has its lens and
// labels.
Status prepare_tray_view(const GivenPicture& picture, const Configuration& configuration,
                         const CardPattern& pattern, TrayViewWorkspace& workspace, StageClock& clock,
                         TrayView& view);

// Its two halves, between which what is labelled may be checked: sizes and regions; all that follows.
Status measure_labels(const FrameView& frame, const Configuration& configuration, TrayView& view);
Status prepare_labelled_view(const GivenPicture& picture, const Configuration& configuration,
                             const CardPattern& pattern, TrayViewWorkspace& workspace, StageClock& clock,
                             TrayView& view);

}  // namespace traygauge
