// Where every part of a segmenter lies in its block: written once, for planning and for taking.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/arena.hpp"
#include "core/pipeline/configuration.hpp"

namespace traygauge {

// Of one view.
struct CardStageWorkspace {
  RimEdgeWorkspace edges;
  CardSearchWorkspace search;
  CardAlignmentWorkspace alignment;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, const Configuration& configuration) {
    edges.allocate(arena, configuration.segmentation.dish.edges);
    search.allocate(arena, configuration.limits.max_frame_width, configuration.limits.max_frame_height,
                    configuration.segmentation.card);
    alignment.allocate(arena, configuration.best.card);
  }
};

// Of one dish: its relief stays while its food is outlined.
struct FoodStageWorkspace {
  DishReliefWorkspace relief;
  std::span<std::uint8_t> cells;
  FoodOutlineWorkspace outline;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, const SegmenterParams& params) {
    relief.allocate_kept(arena, params.relief);
    const std::size_t shared = arena.mark();
    relief.allocate_scratch(arena, params.relief);
    arena.rewind(shared);
    cells = arena.template take<std::uint8_t>(static_cast<std::size_t>(params.food.raster.max_cells));
    outline.allocate(arena, params.food);
  }
};

// What the print looks like and the edges of both views stay; the stages follow each other and share the
// memory behind them.
struct SegmenterMemory {
  PrintCorners print;
  RimEdges edges;
  CardStageWorkspace card;
  DishSearchWorkspace dish;
  FoodStageWorkspace food;

  template <class Allocator>
  constexpr void allocate_kept(Allocator& arena, const SegmenterParams& params) {
    print.allocate(arena, params.card);
    allocate_edges(arena, params.dish.edges);
  }
  template <class Allocator>
  constexpr void allocate_edges(Allocator& arena, const RimEdgeParams& params) {
    for (BoundedList<RimEdge>& list : edges)
      list = BoundedList<RimEdge>(arena.template take<RimEdge>(static_cast<std::size_t>(params.max_edges)));
  }
  template <class Allocator>
  constexpr void allocate(Allocator& arena, const Configuration& configuration) {
    allocate_kept(arena, configuration.segmentation);
    const std::size_t shared = arena.mark();
    card.allocate(arena, configuration);
    arena.rewind(shared);
    dish.allocate(arena, configuration.segmentation.dish);
    arena.rewind(shared);
    food.allocate(arena, configuration.segmentation);
  }
};

// Bytes that a segmenter takes from its block.
constexpr std::size_t segmenter_bytes(const Configuration& configuration) {
  ArenaPlan plan;
  SegmenterMemory memory;
  memory.allocate(plan, configuration);
  return plan.high_water_bytes();
}

}  // namespace traygauge
