// Second derivatives of a Gaussian as box filters over an integral image (Bay et al., section 3.2, figure 2).
#pragma once

#include <cstdint>
#include <span>

#include "core/image_view/image_view.hpp"
#include "core/paper/features/surf.hpp"

namespace traygauge::paper {

// The filter of one layer, centred on a pixel; the smallest, 9 pixels wide, stands for sigma 1.2.
struct BoxFilter {
  int lobe = 3;  // odd; width of one of the three stripes

  constexpr int size() const { return 3 * lobe; }
  constexpr int radius() const { return size() / 2; }
};

inline constexpr float kSigmaPerFilterPixel = 1.2F / 9.0F;

// Increment of the filter size from layer to layer: 6, 12, 24, 48.
constexpr int filter_increment(int octave) {
  return 6 << octave;
}
// 9 15 21 27; 15 27 39 51; 27 51 75 99; …
constexpr BoxFilter filter_of(int octave, int layer) {
  return {1 + (2 << octave) * (layer + 1)};
}

// Responses det(H) of the pixels (0, y), (step, y), …; 0 where the filter sticks out of the picture.
// `workspace` lends its three column buffers.
void compute_response_row(ImageView<const std::uint32_t> integral, BoxFilter filter, int y, int step,
                          SurfWorkspace& workspace, std::span<float> responses);

// The three derivatives at one pixel where the filter fits, as compute_response_row has them.
struct BoxDerivatives {
  float xx = 0.0F;
  float yy = 0.0F;
  float xy = 0.0F;

  // det(H), with (0.9)² to balance boxes against Gaussians (Bay et al., equation 3).
  constexpr float response() const { return xx * yy - 0.81F * xy * xy; }
  // Sign of the trace: +1 for a dark blob, −1 for a bright one.
  constexpr std::int8_t laplacian() const { return xx + yy >= 0.0F ? std::int8_t{1} : std::int8_t{-1}; }
};
BoxDerivatives derivatives_at(ImageView<const std::uint32_t> integral, BoxFilter filter, int x, int y);

}  // namespace traygauge::paper
