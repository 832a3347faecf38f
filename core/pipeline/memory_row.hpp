// What one part of an estimator takes from its block.
#pragma once

#include <cstddef>

#include "core/base/arena.hpp"

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

}  // namespace traygauge
