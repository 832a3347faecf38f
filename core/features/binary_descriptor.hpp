// Oriented binary descriptors of corners: 256 comparisons of smoothed grey values (Calonder et al. 2010,
// BRIEF), in the frame of the patch's intensity centroid (Rublee et al. 2011, ORB). The comparisons are drawn
// by our own generator.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "core/base/geometry.hpp"
#include "core/image_view/image_view.hpp"

namespace traygauge {

inline constexpr int kBinaryPatchRadius = 10;  // px; corners closer to the picture's edge have no descriptor
inline constexpr int kBinaryTurns = 32;        // steps of orientation that the comparisons are turned by

using BinaryDescriptor = std::array<std::uint64_t, 4>;

// Bits that differ in the words `first` to `end`.
inline int hamming_distance(const BinaryDescriptor& a, const BinaryDescriptor& b, std::size_t first,
                            std::size_t end) {
  int distance = 0;
  for (std::size_t i = first; i < end; ++i) distance += std::popcount(a[i] ^ b[i]);
  return distance;
}

inline int hamming_distance(const BinaryDescriptor& a, const BinaryDescriptor& b) {
  return hamming_distance(a, b, 0, a.size());
}

// Which places of the patch are compared, for every turn. 32 KiB.
class BinarySampling {
 public:
  struct Comparison {
    std::array<std::int8_t, 2> first{};  // x, y off the corner
    std::array<std::int8_t, 2> second{};
  };

  void draw(std::uint64_t seed);
  // Turned by the step whose direction lies nearest to this unit vector.
  const std::array<Comparison, 256>& turned_towards(const Vec2& direction) const;

 private:
  std::array<Vec2, kBinaryTurns> directions_;
  std::array<std::array<Comparison, 256>, kBinaryTurns> turns_{};
};

// `smooth` is a picture blurred by box_blur. False too close to the edge, or where the patch has no
// orientation. `direction` is the unit vector towards the intensity centroid.
bool describe_binary(ImageView<const std::uint8_t> smooth, int x, int y, const BinarySampling& sampling,
                     BinaryDescriptor& descriptor, Vec2& direction);

// Means over 3 × 3 pixels; the border keeps its values. Different memory, equal sizes.
void box_blur(ImageView<const std::uint8_t> source, ImageView<std::uint8_t> target);

}  // namespace traygauge
