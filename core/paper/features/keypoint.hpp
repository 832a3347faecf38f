// Salient points and their descriptors: what any detector hands to matching.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/geometry/geometry.hpp"

namespace traygauge::paper {

struct Keypoint {
  Vec2 pixel = Vec2::Zero();  // in the picture that it was detected in
  float scale_px = 0.0F;      // sigma of the filter that answers strongest; about 0.72 of a Gaussian blob's
  float angle_rad = 0.0F;     // orientation
  float response = 0.0F;      // determinant of the Hessian
  std::int8_t laplacian = 0;  // sign of the trace: bright blobs never match dark ones (Bay et al., 4.2)
};

inline constexpr int kDescriptorLength = 64;
using Descriptor = std::array<float, kDescriptorLength>;  // unit length

// The features of one picture. `pixels` is what the matcher and the pose need; both spans have equal length.
struct FeatureSet {
  std::span<const Keypoint> keypoints;
  std::span<const Descriptor> descriptors;
};

}  // namespace traygauge::paper
