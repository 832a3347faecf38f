// Is there a picture at all? (paper III: "good camera exposure and focus")
#pragma once

#include <cstdint>

#include "core/base/status.hpp"
#include "core/image_view/image_view.hpp"

namespace traygauge {

struct ExposureParams {
  std::uint8_t black_level =
      8;  // grey value up to which a pixel holds no information; sensor black is 0 to 4
  double max_black_fraction = 0.95;  // more: frame_too_dark. A dark table around a lit dish stays below 0.8
  double max_burnt_fraction = 0.60;  // more: frame_too_bright. A white dish on a white table stays below 0.4
  double min_deviation = 3.0;        // standard deviation in grey values; less is a uniform picture
};

// frame_too_dark, frame_too_bright, too_few_features (uniform grey), or ok.
Status check_exposure(ImageView<const std::uint8_t> gray, const ExposureParams& params);

}  // namespace traygauge
