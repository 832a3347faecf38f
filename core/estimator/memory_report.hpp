// What the parts of an estimator take from its block.
#pragma once

#include <cstddef>
#include <span>

#include "core/estimator/configuration.hpp"

namespace traygauge {

struct MemoryRow {
  const char* name = "";
  std::size_t bytes = 0;
};

// Fills `storage`, one row a part, and returns the rows that were filled.
std::span<const MemoryRow> memory_rows(const EstimatorLimits& limits, std::span<MemoryRow> storage);

}  // namespace traygauge
