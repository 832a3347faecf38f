// Liquids: a level surface that ends where the dish's wall reaches it.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/surface/height_map.hpp"

namespace traygauge {

struct LevelLiquidParams {
  // Heights within this of the level are the liquid's surface: waves, meniscus and depth noise.
  double tolerance_mm = 2.0;
  // An item is a liquid when so much of its seen area is level …
  double min_level_share = 0.6;
  // … and it reaches the wall at its level, within so much, in so many of 64 directions from the centre; the
  // others are hidden by the near wall or covered by other items.
  double max_gap_mm = 4.0;
  double min_wall_share = 0.8;
  // Shallower than this over the bottom a level item may be a slice.
  double min_depth_mm = 3.0;
};

struct LevelLiquid {
  std::uint8_t label = 0;  // 0: none
  double level_mm = 0.0;   // above the table
};

struct LevelLiquidWorkspace {
  static constexpr std::size_t kBins = 1024;  // heights by 0.125 mm
  std::span<std::uint32_t> histogram;

  template <class Allocator>
  constexpr void allocate(Allocator& arena) {
    histogram = arena.template take<std::uint32_t>(kBins);
  }
};

// Finds the dish's liquid and makes it level in `map`: cells over the wall's inside below the level get its
// label and height unless another item covers them; what stands out of it further than the tolerance keeps
// its height. Cells of the label beyond the wall become the dish. Leaves maps without a liquid as they are.
LevelLiquid level_liquid(const InnerSurface& dish, const LevelLiquidParams& params,
                         LevelLiquidWorkspace& workspace, HeightMap& map);

}  // namespace traygauge
