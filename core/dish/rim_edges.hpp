// Edges of a picture as rays: what the rim of a dish may be among.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/arena.hpp"
#include "core/base/bounded_list.hpp"
#include "core/geometry/camera.hpp"
#include "core/geometry/geometry.hpp"
#include "core/image_view/image_view.hpp"

namespace traygauge {

// Half or twice of any number here changes no volume of six pairs of the captures with found outlines
// (tests/evaluation/numbers.tsv), but for twice of max_px, which turns the glossy egg of m06 over.
struct RimEdgeParams {
  int max_px = 160'000;     // of the picture searched: print and grain of a table shrink, a rim stays an edge
  int max_edges = 4000;     // strongest of them
  int min_difference = 10;  // of grey values over three pixels
};

// A place on an edge, and another one pixel along it with the brighter side on the left, both as rays.
struct RimEdge {
  Vec2 ray = Vec2::Zero();
  Vec2 along = Vec2::Zero();
};

struct RimEdgeWorkspace {
  std::span<std::uint8_t> picture;
  std::span<std::uint16_t> strength;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, const RimEdgeParams& params) {
    picture = arena.template take<std::uint8_t>(static_cast<std::size_t>(params.max_px));
    strength = arena.template take<std::uint16_t>(static_cast<std::size_t>(params.max_px));
  }
};

// The strongest edges of `gray`, thinned to a line (Canny 1986, without its hysteresis). O(pixels).
void collect_rim_edges(ImageView<const std::uint8_t> gray, const LensModel& lens, const RimEdgeParams& params,
                       RimEdgeWorkspace& workspace, BoundedList<RimEdge>& edges);

}  // namespace traygauge
