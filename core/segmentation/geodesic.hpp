// Which seed every cell belongs to: the one from which the way there crosses least colour (geodesic distance,
// as in X. Bai, G. Sapiro, A geodesic framework for fast interactive image and video segmentation, ICCV
// 2007).
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>

#include "core/base/arena.hpp"
#include "core/image_view/image_view.hpp"
#include "core/segmentation/dish_raster.hpp"

namespace traygauge {

// What a step to a neighbour costs: 1, so that in one colour the nearer seed wins, and a sixteenth of the
// squared difference, which counts fourfold in the shares: a shadow's slope is cheap. At most 255.
inline constexpr int kMaxGeodesicStep = std::numeric_limits<std::uint8_t>::max();
int geodesic_step(const CellColour& a, const CellColour& b);

// `owners`: labels of the seeds, kNoOwner elsewhere, kBarred where none may go. Dial's buckets.
inline constexpr std::uint8_t kNoOwner = 0;
inline constexpr std::uint8_t kGlazeSeed = kNoOwner + 1;
inline constexpr std::uint8_t kFoodSeed = kGlazeSeed + 1;
inline constexpr std::uint8_t kBarred = std::numeric_limits<std::uint8_t>::max();

struct GeodesicWorkspace {
  std::span<std::uint16_t> distance;
  std::span<std::int32_t> next;  // in the bucket's list, of which a cell is in one at most
  std::span<std::int32_t> previous;
  std::array<std::int32_t, kMaxGeodesicStep + 1> heads{};

  template <class Allocator>
  constexpr void allocate(Allocator& arena, int max_cells) {
    const auto cells = static_cast<std::size_t>(max_cells);
    distance = arena.template take<std::uint16_t>(cells);
    next = arena.template take<std::int32_t>(cells);
    previous = arena.template take<std::int32_t>(cells);
  }
};

// Gives every cell that can be reached the label of its seed. O(cells).
void spread_owners(ImageView<const CellColour> colours, GeodesicWorkspace& workspace,
                   ImageView<std::uint8_t> owners);

}  // namespace traygauge
