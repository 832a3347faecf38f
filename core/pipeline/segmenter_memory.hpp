// Where every part of a segmenter lies in memory: written once, for planning and for taking.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/arena.hpp"
#include "core/labels/label_borders.hpp"
#include "core/network/network_runner.hpp"
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
    alignment.allocate(arena, configuration.card_alignment);
  }
};

// What the network read and the reliefs of all dishes stay while food is outlined.
struct FoodStageWorkspace {
  std::array<PictureReadingStorage, 2> readings;
  std::array<HeightEvidenceStorage, kMaxPlacedDishes> reliefs;
  std::span<std::byte> network;
  HeightEvidenceWorkspace matching;
  LabelBorders borders;
  std::span<std::uint8_t> cells;
  FoodOutlineWorkspace outline;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, const Configuration& configuration) {
    const SegmenterParams& params = configuration.segmentation;
    for (PictureReadingStorage& reading : readings) reading.allocate(arena, *configuration.network);
    for (HeightEvidenceStorage& relief : reliefs) relief.allocate(arena, params.relief);
    const auto max_cells = static_cast<std::size_t>(params.food.raster.max_cells);
    arena.overlay([&] { network = arena.template take<std::byte>(required_bytes(*configuration.network)); },
                  [&] { matching.allocate(arena, params.relief); }, [&] { borders.allocate(arena); },
                  [&] {
                    cells = arena.template take<std::uint8_t>(max_cells);
                    outline.allocate(arena, params.food);
                  });
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
  std::size_t kept_bytes = 0;  // of the arena, from one view to the next

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
    const std::size_t before = arena.used_bytes();
    allocate_kept(arena, configuration.segmentation);
    kept_bytes = arena.used_bytes() - before;
    arena.overlay([&] { card.allocate(arena, configuration); },
                  [&] { dish.allocate(arena, configuration.segmentation.dish); },
                  [&] { food.allocate(arena, configuration); });
  }
};

}  // namespace traygauge
