#include "core/paper/pipeline/estimator.hpp"
#include "core/paper/pipeline/estimator_memory.hpp"

namespace traygauge::paper {

std::array<MemoryRow, kMemoryRowCount> describe_memory(const Configuration& configuration) {
  EstimatorMemory memory;
  const auto view = bytes_of([&](ArenaPlan& plan) { memory.views[0].allocate(plan, configuration.caps); });
  return {{
      {"state", estimator_state_bytes(), false},
      {"card pattern", bytes_of([&](ArenaPlan& plan) { memory.pattern.allocate(plan, configuration.caps); }),
       false},
      {"first view", view, false},
      {"second view", view, false},
      {"calibrated pair", bytes_of([&](ArenaPlan& plan) {
         memory.given.allocate(plan, configuration.caps);
         memory.extrinsics.allocate(plan, configuration.caps);
       }),
       false},
      {"view preparation",
       bytes_of([&](ArenaPlan& plan) { memory.preparation.allocate(plan, configuration); }), true},
      {"extrinsic calibration",
       bytes_of([&](ArenaPlan& plan) { memory.calibration.allocate(plan, configuration); }), true},
      {"dense reconstruction and volume",
       bytes_of([&](ArenaPlan& plan) { memory.allocate_reconstruction(plan, configuration); }), true},
  }};
}

}  // namespace traygauge::paper
