// The reproducible direction of a keypoint (Bay et al., section 4.1).
#pragma once

#include <cstdint>

#include "core/image_view/image_view.hpp"
#include "core/paper/features/keypoint.hpp"

namespace traygauge::paper {

// A unit vector; (1, 0) on uniform ground.
struct Direction {
  float cosine = 1.0F;
  float sine = 0.0F;
};

// The direction of the largest sum of Haar responses (size 6 sigma, within 6 sigma, Gaussian weights of 2.5
// sigma) in a window of 60°, turned in steps of 5°.
Direction find_orientation(ImageView<const std::uint32_t> integral, const Keypoint& keypoint);

}  // namespace traygauge::paper
