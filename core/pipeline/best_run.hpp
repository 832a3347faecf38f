// Profile `best` from two prepared views to the volumes.
#pragma once

#include <cstdint>

#include "core/pipeline/best_memory.hpp"
#include "core/pipeline/measurement.hpp"
#include "core/pipeline/stage_clock.hpp"
#include "core/pipeline/stage_observer.hpp"

namespace traygauge {

// Fills everything but the times. The view that shows more of the dishes is worked first, so that a pair
// measures the same bits in either order. `tap` may be null.
void run_best(BestMemory& memory, const Configuration& configuration, std::uint64_t seed, StageTap* tap,
              StageClock& clock, Measurement& measurement);

}  // namespace traygauge
