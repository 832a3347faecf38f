#include "core/pipeline/memory_report.hpp"

#include "core/pipeline/estimator_memory.hpp"

namespace traygauge {
namespace {

std::array<MemoryRow, kMemoryRowCount> describe_best(const Configuration& configuration) {
  BestMemory memory;
  const auto view = bytes_of([&](ArenaPlan& plan) { memory.views[0].allocate(plan, configuration.limits); });
  return {{
      {"state", estimator_state_bytes(), false},
      {"card pattern",
       bytes_of([&](ArenaPlan& plan) { memory.pattern.allocate(plan, configuration.best.card.pattern); }),
       false},
      {"first view", view, false},
      {"second view", view, false},
      {"cameras and dishes", bytes_of([](ArenaPlan& plan) { plan.take<SceneGeometry>(1); }), false},
      {"height maps and items",
       bytes_of([&](ArenaPlan& plan) { memory.dish.allocate_kept(plan, configuration); }), false},
      {"view preparation",
       bytes_of([&](ArenaPlan& plan) { memory.preparation.allocate(plan, configuration); }), true},
      {"tracks, dense matching, volume", bytes_of([&](ArenaPlan& plan) {
         memory.geometry.allocate(plan, configuration);
         memory.dish.allocate(plan, configuration);
       }),
       true},
  }};
}

std::array<MemoryRow, kMemoryRowCount> describe_paper(const Configuration& configuration) {
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

}  // namespace

std::array<MemoryRow, kMemoryRowCount> describe_memory(const Configuration& configuration) {
  return configuration.profile == Profile::best ? describe_best(configuration)
                                                : describe_paper(configuration);
}

}  // namespace traygauge
