// What the parts of an estimator take from its block.
#pragma once

#include <array>
#include <cstddef>

#include "core/base/arena.hpp"
#include "core/pipeline/configuration.hpp"

namespace traygauge {

struct MemoryRow {
  const char* name = "";
  std::size_t bytes = 0;
  bool shared = false;  // lies over the other shared rows: only the largest of them counts
};

// Bytes that one part takes.
template <class Allocate>
std::size_t bytes_of(Allocate&& allocate) {
  ArenaPlan plan;
  allocate(plan);
  return plan.high_water_bytes();
}

inline constexpr std::size_t kMemoryRowCount = 8;

// One row a part; the kept rows and the largest shared one add up to required_bytes().
std::array<MemoryRow, kMemoryRowCount> describe_memory(const Configuration& configuration);

inline constexpr std::size_t kSegmenterRowCount = 5;

// The same of a segmenter, and segmenter_bytes().
std::array<MemoryRow, kSegmenterRowCount> describe_segmenter(const Configuration& configuration);

}  // namespace traygauge
