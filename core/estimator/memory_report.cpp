#include "core/estimator/memory_report.hpp"

#include "core/estimator/estimator_memory.hpp"

namespace traygauge {
namespace {

// Bytes that one part takes.
template <class Allocate>
std::size_t bytes_of(Allocate&& allocate) {
  ArenaPlan plan;
  allocate(plan);
  return plan.high_water_bytes();
}

}  // namespace

std::array<MemoryRow, kMemoryRowCount> describe_memory(const Configuration& configuration) {
  EstimatorMemory memory;
  const auto view = bytes_of([&](ArenaPlan& plan) { memory.views[0].allocate(plan, configuration.limits); });
  return {{
      {"state", estimator_state_bytes(), false},
      {"card pattern",
       bytes_of([&](ArenaPlan& plan) { memory.pattern.allocate(plan, configuration.limits); }), false},
      {"first view", view, false},
      {"second view", view, false},
      {"calibrated pair", bytes_of([&](ArenaPlan& plan) {
         memory.given.allocate(plan, configuration.limits);
         memory.extrinsics.allocate(plan, configuration.limits);
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

}  // namespace traygauge
