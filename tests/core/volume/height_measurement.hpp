// Height map to volumes, as a measurement runs them.
#pragma once

#include <span>
#include <vector>

#include "core/volume/height_volume.hpp"
#include "core/volume/level_liquid.hpp"
#include "core/volume/overhang.hpp"
#include "tests/support/allocated.hpp"

namespace traygauge::test {

struct HeightMeasurement {
  static constexpr std::size_t kMaxCells = 400 * 400;
  static constexpr std::size_t kMaxGridWidth = 1024;

  std::vector<HeightCell> cells = std::vector<HeightCell>(kMaxCells);
  Allocated<HeightMapWorkspace> map_space{kMaxCells, kMaxGridWidth};
  Allocated<HeightVolumeWorkspace> volume_space;
  Allocated<LevelLiquidWorkspace> liquid_space;
  HeightMap map;
  LevelLiquid liquid;
  // True depth shows all of an undercut.
  OverhangParams overhang{.wall_undercut_fraction = 0.2, .fruit_undercut_fraction = 0.2};

  LabelSet round;  // as round bodies

  Status run(std::span<const SurfaceGrid> views, const InnerSurface& dish,
             const HeightMapParams& params = {.hidden_steepness = 1.0}) {
    const Status built = build_height_map(views, dish, params, cells, *map_space, map);
    if (!built.ok()) return built;
    liquid = level_liquid(views, dish, {}, *liquid_space, map);
    const Status integrated = integrate_height_map(map, dish, {}, *volume_space);
    close_overhangs(views, map, dish, round, overhang, volume_space->items);
    return integrated;
  }
  const HeightVolume& item(int label) { return volume_space->items[static_cast<std::size_t>(label)]; }
};

}  // namespace traygauge::test
