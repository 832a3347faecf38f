// Where dish and food are outlined.
#pragma once

#include <cstdint>

namespace traygauge {

enum class LabelSource : std::uint8_t {
  given,      // by label pictures
  automatic,  // by the segmentation
};

}  // namespace traygauge
