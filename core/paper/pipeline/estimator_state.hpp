// What an estimator keeps in its block.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/paper/pipeline/estimator.hpp"
#include "core/paper/pipeline/estimator_memory.hpp"
#include "core/pipeline/stage_clock.hpp"

namespace traygauge::paper {

struct EstimatorState {
  Configuration configuration;  // without the pattern's pixels, which are read at construction only
  std::array<DishModel, kMaxDishCandidates> dishes{};
  EstimatorMemory memory;
  Extrinsics extrinsics;  // its lists lie in `memory`
  WorkingPictures pictures;
  std::size_t reserved_bytes = 0;
  std::size_t used_bytes = 0;
  double setup_ms = 0.0;
  int views = 0;        // taken so far
  Status views_status;  // the first thing that went wrong with them
  StageClock preparation_clock;
  MotionSearch* motion_search = nullptr;  // null: RANSAC

  PreparedView& view(int i) { return memory.views[static_cast<std::size_t>(i)]; }

  // The stages take the view that shows more of the dish first, so that a pair measures the same bits in
  // either order.
  bool works_in_reverse() const {
    return memory.views[1].regions.dish_pixels > memory.views[0].regions.dish_pixels;
  }
  int worked_index(int i) const { return works_in_reverse() ? 1 - i : i; }
  PreparedView& worked_view(int i) { return view(worked_index(i)); }
};

// From both prepared views to the volumes (paper Fig. 2). Fills everything but the times.
void run_measurement(EstimatorState& state, std::uint64_t seed, StageClock& clock, Measurement& measurement);

}  // namespace traygauge::paper
