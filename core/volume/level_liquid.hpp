// Liquids: a level surface that ends where the dish's wall reaches it.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/volume/height_map.hpp"

namespace traygauge {

// Half or twice of any number here moves the MAPE of six pairs of the captures by 0.05 points at most
// (tests/evaluation/numbers.tsv), but for half of contact_tolerance_mm (0.31) and of solid_sigmas (0.15), and
// for twice of the shares, which is all or more.
struct LevelLiquidParams {
  // Where the outline ends at a dish's wall within this of one height, the wall says how high that is …
  double contact_tolerance_mm = 1.0;
  // … when so much of the outline does: the near wall hides up to half, other items some of the rest.
  double min_contact_fraction = 0.5;
  // Without such an outline: heights within this of the level are the liquid's surface, waves, meniscus and
  // depth noise, and an item is a liquid when so much of its seen area is level.
  double tolerance_mm = 2.0;
  double min_level_fraction = 0.6;
  // It reaches the wall at its level, within so much, in so many of 64 directions from the centre; the others
  // are hidden by the near wall or covered by other items. Matched heights that lie further from the wall's
  // level are of something that stands on the wall.
  double max_gap_mm = 4.0;
  double min_wall_fraction = 0.8;
  // Shallower than this over the bottom a level item may be a slice.
  double min_depth_mm = 3.0;
  // Solids stand out of it by more than so many times the noise of its surface, and at least by this.
  double solid_sigmas = 2.0;
  double min_solid_mm = 0.5;
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
// label and height unless another item covers them; solids that stand out of it keep their height. Cells of
// the label beyond the wall become the dish. Leaves maps without a liquid as they are. `views` are those that
// the map is made of, the dish's samples on its surface.
LevelLiquid level_liquid(std::span<const SurfaceGrid> views, const InnerSurface& dish,
                         const LevelLiquidParams& params, LevelLiquidWorkspace& workspace, HeightMap& map);

}  // namespace traygauge
