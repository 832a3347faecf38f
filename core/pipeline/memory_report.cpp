#include "core/pipeline/memory_report.hpp"

#include "core/pipeline/tray_estimator.hpp"
#include "core/pipeline/tray_memory.hpp"

namespace traygauge {
namespace {

// Of finding labels: what is kept while its stages follow each other counts with the largest of them.
std::size_t segmentation_bytes(const Configuration& configuration, const auto& allocate_stage) {
  if (configuration.network == nullptr) return 0;
  SegmenterMemory memory;
  return bytes_of([&](ArenaPlan& plan) {
    memory.allocate_kept(plan, configuration.segmentation);
    allocate_stage(memory, plan);
  });
}

}  // namespace

std::array<MemoryRow, kMemoryRowCount> describe_memory(const Configuration& configuration) {
  TrayMemory memory;
  const SegmenterParams& segmentation = configuration.segmentation;
  const auto view = bytes_of([&](ArenaPlan& plan) { memory.views[0].allocate(plan, configuration.limits); });
  const auto labels = bytes_of([&](ArenaPlan& plan) {
    if (configuration.network != nullptr) memory.allocate_found(plan, configuration);
  });
  return {{
      {"state", estimator_state_bytes(), false},
      {"card pattern", bytes_of([&](ArenaPlan& plan) {
         memory.pattern.allocate(plan, configuration.card_alignment.pattern);
       }),
       false},
      {"first view", view, false},
      {"second view", view, false},
      {"labels and rims found", labels, false},
      {"cameras and dishes", bytes_of([](ArenaPlan& plan) { plan.take<SceneGeometry>(1); }), false},
      {"height maps and items",
       bytes_of([&](ArenaPlan& plan) { memory.dish.allocate_kept(plan, configuration); }), false},
      {"finding the card",
       segmentation_bytes(configuration, [&](SegmenterMemory& parts,
                                             ArenaPlan& plan) { parts.card.allocate(plan, configuration); }),
       true},
      {"finding dishes",
       segmentation_bytes(
           configuration,
           [&](SegmenterMemory& parts, ArenaPlan& plan) { parts.dish.allocate(plan, segmentation.dish); }),
       true},
      {"finding food",
       segmentation_bytes(configuration, [&](SegmenterMemory& parts,
                                             ArenaPlan& plan) { parts.food.allocate(plan, configuration); }),
       true},
      {"view preparation",
       bytes_of([&](ArenaPlan& plan) { memory.preparation.allocate(plan, configuration); }), true},
      {"tracks, dense matching, volume",
       bytes_of([&](ArenaPlan& plan) { memory.allocate_measurement(plan, configuration); }), true},
  }};
}

}  // namespace traygauge
