// From two prepared views to the volumes of what lies on every dish.
#pragma once

#include <cstdint>

#include "core/pipeline/measurement.hpp"
#include "core/pipeline/segmentation.hpp"
#include "core/pipeline/stage_clock.hpp"
#include "core/pipeline/stage_observer.hpp"
#include "core/pipeline/tray_memory.hpp"

namespace traygauge {

// Where cameras, card and dishes are and whether they contradict each other: less than a third of the time
// of the whole. The view that shows more of the dishes is worked first, so that a pair measures the same bits
// in either order. `found`: where the labels come from, null where they were given. `observer` may be null.
void locate_tray(TrayMemory& memory, const Configuration& configuration, const Segmentation* found,
                 std::uint64_t seed, StageObserver* observer, StageClock& clock, Measurement& measurement);

// The same, and then what lies on the dishes. Fills everything but the times.
void measure_tray(TrayMemory& memory, const Configuration& configuration, const Segmentation* found,
                  std::uint64_t seed, StageObserver* observer, StageClock& clock, Measurement& measurement);

}  // namespace traygauge
