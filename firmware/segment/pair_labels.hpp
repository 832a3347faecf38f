// The label pictures of a pair, drawn by the segmentation.
#pragma once

#include <array>
#include <cstddef>

#include "core/estimator/segmenter.hpp"
#include "firmware/measure/pair_setup.hpp"
#include "simulator/capture/capture.hpp"

namespace traygauge {

struct PairLabels {
  std::array<Picture, 2> labels;
  Segmentation segmentation;
  std::size_t reserved_bytes = 0;
};

// `configuration` as configure() gives it for `setup`. Where the segmentation fails, its status says why.
PairLabels label_pair(const Configuration& configuration, const PairSetup& setup,
                      const std::array<LoadedView, 2>& views);

}  // namespace traygauge
