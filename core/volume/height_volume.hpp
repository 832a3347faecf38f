// Volume of every item under a height map.
#pragma once

#include <cstdint>
#include <span>

#include "core/base/status.hpp"
#include "core/geometry/geometry.hpp"
#include "core/volume/height_map.hpp"

namespace traygauge {

struct HeightVolume {
  double volume_ml = 0.0;         // closed: without the air under an overhang
  double column_volume_ml = 0.0;  // all that lies between upper surface and dish
  double closing_sigma_ml = 0.0;  // of volume_ml, where it is unsure whether the item overhangs
  double hidden_volume_ml = 0.0;  // of the column volume, what no view sees
  double area_mm2 = 0.0;
  double mean_height_mm = 0.0;
  double max_height_mm = 0.0;
  double hidden_fraction = 0.0;   // of the area
  double border_fraction = 0.0;   // of the area, in cells at the item's outline
  double undercut_mm2 = 0.0;      // below this area of the item a view sees another surface
  double wall_mm2 = 0.0;          // seen from the side: of walls within the item
  Vec3 centre_mm = Vec3::Zero();  // of its upper surface where a view tells of it, table frame
};

// Half or twice of either number changes no volume of six pairs of the captures
// (tests/evaluation/numbers.tsv).
struct HeightVolumeParams {
  // The highest so much of an item's area does not count as its greatest height, where noise peaks.
  double max_height_ignored_mm2 = 3.0;
  // What rises by more per way is a wall: views see its place and not its height. Smaller counts slopes,
  // larger loses the sides of balls.
  double wall_slope = 1.5;
};

struct HeightVolumeWorkspace {
  static constexpr std::size_t kBins = 256;  // of 0.5 mm

  std::span<HeightVolume> items;        // by label
  std::span<std::uint32_t> histograms;  // of heights, by label

  template <class Allocator>
  constexpr void allocate(Allocator& arena) {
    items = arena.template take<HeightVolume>(256);
    histograms = arena.template take<std::uint32_t>(256 * kBins);
  }
};

// Sums (height − dish) · area over the item cells of `map` into `workspace.items`. A cell counts whole, with
// the label at its centre: sampled areas have no bias. Surface below the dish counts negative. no_food_label
// when no cell has an item's label.
Status integrate_height_map(const HeightMap& map, const InnerSurface& dish, const HeightVolumeParams& params,
                            HeightVolumeWorkspace& workspace);

}  // namespace traygauge
