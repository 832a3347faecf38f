// Where every part of a TrayEstimator lies in its block: written once, for planning and for taking.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/pipeline/configuration.hpp"
#include "core/pipeline/scene_geometry.hpp"
#include "core/pipeline/segmenter_memory.hpp"
#include "core/pipeline/surface_measurement.hpp"
#include "core/pipeline/tray_view.hpp"

namespace traygauge {

// The card's pattern, both views and the results stay; the stages follow each other and share the memory
// behind them.
struct TrayMemory {
  CardPattern pattern;
  std::array<TrayView, 2> views;
  std::array<ImageView<std::uint8_t>, 2>
      found_labels;  // memory for the largest frame; none: labels are given
  std::array<std::array<SeenRim, kMaxPlacedDishes>, 2>
      seen_rims;  // of the same views: none where labels are given
  SurfaceMeasurementWorkspace dish;
  std::span<SceneGeometry> scene;  // one
  TrayViewWorkspace preparation;
  SegmenterMemory segmentation;
  SceneGeometryWorkspace geometry;
  std::size_t kept_bytes = 0;  // of the arena, up to where the stages share

  template <class Allocator>
  constexpr void allocate_kept(Allocator& arena, const Configuration& configuration) {
    pattern.allocate(arena, configuration.card_alignment.pattern);
    for (TrayView& view : views) view.allocate(arena, configuration.limits);
    if (configuration.network != nullptr) allocate_found(arena, configuration);
    scene = arena.template take<SceneGeometry>(1);
    dish.allocate_kept(arena, configuration);
  }
  template <class Allocator>
  constexpr void allocate_found(Allocator& arena, const Configuration& configuration) {
    const FrameLimits& limits = configuration.limits;
    for (auto& labels : found_labels)
      labels = arena.template take_image<std::uint8_t>(limits.max_frame_width, limits.max_frame_height);
    const auto points = static_cast<std::size_t>(configuration.segmentation.dish.outline_points);
    for (auto& rims : seen_rims) {
      for (SeenRim& rim : rims) rim.rays = BoundedList<Vec2>(arena.template take<Vec2>(points));
    }
  }
  // The tracks are still read while dishes are measured.
  template <class Allocator>
  constexpr void allocate_measurement(Allocator& arena, const Configuration& configuration) {
    geometry.allocate(arena, configuration);
    dish.allocate(arena, configuration);
  }
  template <class Allocator>
  constexpr void allocate_segmentation(Allocator& arena, const Configuration& configuration) {
    if (configuration.network != nullptr) segmentation.allocate(arena, configuration);
  }
  template <class Allocator>
  constexpr void allocate(Allocator& arena, const Configuration& configuration) {
    allocate_kept(arena, configuration);
    kept_bytes = arena.used_bytes();
    arena.overlay([&] { allocate_segmentation(arena, configuration); },
                  [&] { preparation.allocate(arena, configuration); },
                  [&] { allocate_measurement(arena, configuration); });
  }
};

}  // namespace traygauge
