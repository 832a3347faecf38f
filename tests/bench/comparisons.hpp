// Each stage of the measurement beside its peers from OpenCV.
#pragma once

#include <vector>

#include "tests/bench/comparison.hpp"
#include "tests/bench/stage_data.hpp"

namespace traygauge::bench {

// `data` outlives the comparisons.
std::vector<Comparison> compare_sparse_stages(const StageData& data);
std::vector<Comparison> compare_dense_stages(const StageData& data);
// From decoded frames to volumes.
Comparison compare_measurement(const Scene& scene);

}  // namespace traygauge::bench
