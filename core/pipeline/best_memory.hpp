// Where every part of profile `best` lies in the estimator's block.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/pipeline/best_view.hpp"
#include "core/pipeline/configuration.hpp"
#include "core/pipeline/dish_measurement.hpp"
#include "core/pipeline/scene_geometry.hpp"

namespace traygauge {

// The card's pattern, both views and the results stay; the stages follow each other and share the memory
// behind them.
struct BestMemory {
  CardPattern pattern;
  std::array<BestView, 2> views;
  BestViewWorkspace preparation;
  SceneGeometryWorkspace geometry;
  std::span<SceneGeometry> scene;  // one
  DishMeasurementWorkspace dish;
  std::size_t kept_bytes = 0;  // of the arena, up to where the stages share

  template <class Allocator>
  constexpr void allocate(Allocator& arena, const Configuration& configuration) {
    pattern.allocate(arena, configuration.best.card.pattern);
    for (BestView& view : views) view.allocate(arena, configuration.limits);
    scene = arena.template take<SceneGeometry>(1);
    dish.allocate_kept(arena, configuration);
    kept_bytes = arena.mark();
    preparation.allocate(arena, configuration);
    arena.rewind(kept_bytes);
    // The tracks are still read while dishes are measured.
    geometry.allocate(arena, configuration);
    dish.allocate(arena, configuration);
  }
};

}  // namespace traygauge
