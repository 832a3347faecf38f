// A pair of corresponding salient points.
#pragma once

#include <cstdint>

namespace traygauge::paper {

struct Match {
  std::int32_t first = 0;   // index into the first picture's features
  std::int32_t second = 0;  // index into the second picture's
  float distance = 0.0F;    // Euclidean distance of the descriptors
};

}  // namespace traygauge::paper
