#include "core/pipeline/segmenter_memory.hpp"

#include "core/pipeline/memory_report.hpp"

namespace traygauge {

std::array<MemoryRow, kSegmenterRowCount> describe_segmenter(const Configuration& configuration) {
  SegmenterMemory memory;
  const SegmenterParams& params = configuration.segmentation;
  return {{
      {"corners of the print", bytes_of([&](ArenaPlan& plan) { memory.print.allocate(plan, params.card); }),
       false},
      {"edges of both views",
       bytes_of([&](ArenaPlan& plan) { memory.allocate_edges(plan, params.dish.edges); }), false},
      {"card search", bytes_of([&](ArenaPlan& plan) { memory.card.allocate(plan, configuration); }), true},
      {"dish search", bytes_of([&](ArenaPlan& plan) { memory.dish.allocate(plan, params.dish); }), true},
      {"food and its relief", bytes_of([&](ArenaPlan& plan) { memory.food.allocate(plan, params); }), true},
  }};
}

}  // namespace traygauge
