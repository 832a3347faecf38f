// Each stage of both profiles beside its peers from OpenCV.
#pragma once

#include <vector>

#include "tests/bench/best_data.hpp"
#include "tests/bench/comparison.hpp"
#include "tests/bench/stage_data.hpp"

namespace traygauge::bench {

// `data` outlives the comparisons.
std::vector<Comparison> compare_sparse_stages(const StageData& data);
std::vector<Comparison> compare_dense_stages(const StageData& data);
std::vector<Comparison> compare_best_sparse_stages(const BestData& data);
std::vector<Comparison> compare_best_dense_stages(const BestData& data);
// Labels drawn in two views.
Comparison compare_segmentation(const Scene& scene);
// From decoded frames to volumes.
Comparison compare_measurement(const Scene& scene);
Comparison compare_paper_measurement(const Scene& scene);

}  // namespace traygauge::bench
