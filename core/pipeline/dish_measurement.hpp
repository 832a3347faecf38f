// One dish from dense matching to the volumes of what lies on it.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/base/arena.hpp"
#include "core/base/bounded_list.hpp"
#include "core/base/status.hpp"
#include "core/pipeline/measurement.hpp"
#include "core/pipeline/scene_geometry.hpp"
#include "core/pipeline/stage_observer.hpp"
#include "core/pipeline/tray_view.hpp"
#include "core/volume/round_body.hpp"

namespace traygauge {

struct DishMeasurementWorkspace {
  DenseStereoWorkspace surface;
  RoundBodyWorkspace round_body;
  HeightMapWorkspace height_map;
  LevelLiquidWorkspace liquid;
  HeightVolumeWorkspace volume;
  std::span<HeightCell> cells;  // of the height maps of all dishes
  BoundedList<MeasuredSurface> surfaces;
  BoundedList<ItemResult> items;

  template <class Allocator>
  constexpr void allocate_kept(Allocator& arena, const Configuration& configuration) {
    cells = arena.template take<HeightCell>(configuration.pipeline.max_height_cells);
    surfaces = BoundedList<MeasuredSurface>(arena.template take<MeasuredSurface>(kMaxPlacedDishes));
    items = BoundedList<ItemResult>(arena.template take<ItemResult>(kMaxItems));
  }
  template <class Allocator>
  constexpr void allocate(Allocator& arena, const Configuration& configuration) {
    const DenseStereoParams& params = configuration.surface;
    surface.allocate(arena, params);
    round_body.allocate(arena, params.rectification.max_rows, params.max_columns);
    height_map.allocate(arena, configuration.pipeline.max_height_cells,
                        static_cast<std::size_t>(params.max_columns));
    liquid.allocate(arena);
    volume.allocate(arena);
  }
};

// Appends the items on dish `index` of `geometry` to `workspace.items`, and its height map to
// `workspace.surfaces`. What fails here fails for all of them: every item then carries that status.
void measure_dish(const ViewPair& views, const SceneGeometry& geometry, std::size_t index,
                  const Configuration& configuration, DishMeasurementWorkspace& workspace,
                  StageObserver* observer, StageClock& clock, Measurement& measurement);

}  // namespace traygauge
