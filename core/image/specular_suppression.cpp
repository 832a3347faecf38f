#include "core/image/specular_suppression.hpp"

#include <algorithm>
#include <cmath>

#include "core/image/gray_weights.hpp"
#include "core/image/resample.hpp"

namespace traygauge {

void suppress_specular(const FrameView& frame, const SpecularParams& params,
                       ImageView<std::uint8_t> specular) {
  if (frame.format == PixelFormat::gray8) return convert_to_gray(frame, specular);
  const GrayWeights weights = gray_weights(frame.format);
  constexpr auto kOne = static_cast<float>(kGrayOne);
  const float first = static_cast<float>(weights.first) / kOne;
  const float second = static_cast<float>(weights.second) / kOne;
  const float third = static_cast<float>(weights.third) / kOne;
  const auto share = static_cast<float>(params.specular_fraction);
  for (int y = 0; y < frame.height; ++y) {
    const std::uint8_t* pixel = frame.data + y * frame.stride_bytes;
    std::uint8_t* out = specular.row(y);
    for (int x = 0; x < frame.width; ++x, pixel += 3) {
      const auto a = static_cast<float>(pixel[0]);
      const auto b = static_cast<float>(pixel[1]);
      const auto c = static_cast<float>(pixel[2]);
      const float least = std::min(std::min(a, b), c);
      const float light = first * a * a + second * b * b + third * c * c - share * least * least;
      out[x] = static_cast<std::uint8_t>(std::sqrt(std::max(light, 0.0F)) + 0.5F);
    }
  }
}

}  // namespace traygauge
