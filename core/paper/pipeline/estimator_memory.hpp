// Where every part of an estimator lies in its block: written once, for planning and for taking.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/arena.hpp"
#include "core/paper/pipeline/configuration.hpp"
#include "core/paper/pipeline/dense_reconstruction.hpp"
#include "core/paper/pipeline/extrinsic_calibration.hpp"
#include "core/paper/pipeline/view_preparation.hpp"
#include "core/paper/pipeline/volume_extraction.hpp"

namespace traygauge::paper {

// Features of the card's print.
struct PatternMemory {
  BoundedList<Keypoint> keypoints;
  std::span<Descriptor> descriptors;
  std::span<Vec2> positions_mm;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, const Caps& caps) {
    const auto count = static_cast<std::size_t>(caps.max_pattern_keypoints);
    keypoints = BoundedList<Keypoint>(arena.template take<Keypoint>(count));
    descriptors = arena.template take<Descriptor>(count);
    positions_mm = arena.template take<Vec2>(count);
  }
};

// The views and the pattern stay; preparation, extrinsic calibration and dense reconstruction follow each
// other and share the memory behind them.
struct EstimatorMemory {
  PatternMemory pattern;
  std::array<PreparedView, 2> views;
  GivenCorrespondences given;
  ExtrinsicStorage extrinsics;
  PreparationWorkspace preparation;
  ExtrinsicWorkspace calibration;
  DenseWorkspace dense;
  VolumeExtractionWorkspace extraction;

  template <class Allocator>
  constexpr void allocate_kept(Allocator& arena, const Configuration& configuration) {
    pattern.allocate(arena, configuration.caps);
    for (PreparedView& view : views) view.allocate(arena, configuration.caps);
    given.allocate(arena, configuration.caps);
    extrinsics.allocate(arena, configuration.caps);
  }
  template <class Allocator>
  constexpr void allocate_reconstruction(Allocator& arena, const Configuration& configuration) {
    dense.allocate(arena, configuration);
    extraction.allocate(arena, configuration);
  }
  template <class Allocator>
  constexpr void allocate(Allocator& arena, const Configuration& configuration) {
    allocate_kept(arena, configuration);
    arena.overlay([&] { preparation.allocate(arena, configuration); },
                  [&] { calibration.allocate(arena, configuration); },
                  [&] { allocate_reconstruction(arena, configuration); });
  }
};

// Of the estimator's own state, at the head of the block.
std::size_t estimator_state_bytes();

// Of everything behind it.
constexpr std::size_t planned_bytes(const Configuration& configuration) {
  ArenaPlan plan;
  EstimatorMemory memory;
  memory.allocate(plan, configuration);
  return plan.high_water_bytes();
}

}  // namespace traygauge::paper
