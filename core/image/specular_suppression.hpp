// A grey picture with less of the lamps' reflections. What a wet or glossy food reflects lies below its
// surface and moves otherwise than its texture between the views; it adds the same light to all three colours
// (the dichromatic model, Shafer 1985).
#pragma once

#include <cstdint>

#include "core/image_view/image_view.hpp"

namespace traygauge {

struct SpecularParams {
  // Of the light that a pixel's least colour has, taken away from its grey: 1 leaves nothing of a white
  // food's texture, 0 all of the reflections.
  double specular_fraction = 0.3;
};

// `matte` has the frame's size; a grey frame is copied. Stored values are taken for square roots of light.
void suppress_specular(const FrameView& frame, const SpecularParams& params,
                       ImageView<std::uint8_t> specular);

}  // namespace traygauge
