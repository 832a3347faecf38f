// One surface that food lies on, a dish's or the tray's, from dense matching to the volumes of its items.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/base/arena.hpp"
#include "core/base/bounded_list.hpp"
#include "core/base/result.hpp"
#include "core/base/status.hpp"
#include "core/pipeline/measurement.hpp"
#include "core/pipeline/scene_geometry.hpp"
#include "core/pipeline/stage_observer.hpp"
#include "core/pipeline/tray_view.hpp"
#include "core/volume/round_body.hpp"

namespace traygauge {

struct SurfaceMeasurementWorkspace {
  DenseStereoWorkspace surface;
  RoundBodyWorkspace round_body;
  HeightMapWorkspace height_map;
  LevelLiquidWorkspace liquid;
  HeightVolumeWorkspace volume;
  std::span<HeightCell> cells;  // for the height maps of all surfaces: those that are left
  BoundedList<MeasuredSurface> surfaces;
  BoundedList<ItemResult> items;

  template <class Allocator>
  constexpr void allocate_kept(Allocator& arena, const Configuration& configuration) {
    cells = arena.template take<HeightCell>(configuration.pipeline.max_tray_cells);
    surfaces = BoundedList<MeasuredSurface>(arena.template take<MeasuredSurface>(kMaxMeasuredSurfaces));
    items = BoundedList<ItemResult>(arena.template take<ItemResult>(kMaxItems));
  }
  template <class Allocator>
  constexpr void allocate(Allocator& arena, const Configuration& configuration) {
    const DenseStereoParams& params = configuration.surface;
    surface.allocate(arena, params, [&] {
      round_body.allocate(arena, params.rectification.max_rows, params.max_columns);
      height_map.allocate(arena, configuration.pipeline.max_height_cells,
                          static_cast<std::size_t>(params.max_columns));
      liquid.allocate(arena);
      volume.allocate(arena);
    });
  }
};

// What measuring on any surface of a tray takes; `observer` may be null.
struct TrayAtWork {
  const ViewPair& views;
  const SceneGeometry& geometry;
  const Configuration& configuration;
  SurfaceMeasurementWorkspace& workspace;
  StageObserver* observer;
  StageClock& clock;
  Measurement& measurement;
};

struct FoodSurface {
  std::uint8_t dish = kDishLabel;  // that it belongs to, or a place of the tray
  LabelSet labels;                 // of what lies on it, and its own
  InnerSurface inner;
  double shape_sigma_mm = 0.0;  // of the surface's height, where it is not known

  double bottom_mm() const { return inner.profile.bottom_height_mm(); }
};

// Both views matched over a surface; what shows the surface itself lies on it.
struct MatchedSurface {
  std::array<SurfaceGrid, 2> grids;
  DenseStereoReport dense;
};

// `views` show the surface, of which `kept` makes kDishLabel, and the items.
Result<MatchedSurface> match_on_surface(const TrayAtWork& tray, const FoodSurface& surface,
                                        const std::array<StoredView, 2>& views, const LabelTable& kept);

// Appends the items to the workspace's, and the surface's height map to its surfaces. What fails here fails
// for all of them.
Status measure_on_surface(const TrayAtWork& tray, const FoodSurface& surface, MatchedSurface matched);

// Every item among `labels` gets that status.
void refuse_items(const TrayAtWork& tray, const LabelSet& labels, std::uint8_t dish, Status status);

}  // namespace traygauge
