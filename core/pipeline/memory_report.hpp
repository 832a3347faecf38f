// What the parts of a TrayEstimator take from its block.
#pragma once

#include <array>
#include <cstddef>

#include "core/pipeline/configuration.hpp"
#include "core/pipeline/memory_row.hpp"

namespace traygauge {

inline constexpr std::size_t kMemoryRowCount = 12;  // the parts that describe_memory() lists

// One row a part; the kept rows and the largest shared one add up to required_bytes().
std::array<MemoryRow, kMemoryRowCount> describe_memory(const Configuration& configuration);

}  // namespace traygauge
