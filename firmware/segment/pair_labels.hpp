// The label pictures of a pair that nobody outlined, as they were found.
#pragma once

#include <array>
#include <cstddef>

#include "core/pipeline/segmentation.hpp"
#include "simulator/capture/picture.hpp"

namespace traygauge {

struct PairLabels {
  std::array<Picture, 2> labels;
  Segmentation segmentation;
  std::size_t reserved_bytes = 0;  // of the estimator that found them
};

}  // namespace traygauge
