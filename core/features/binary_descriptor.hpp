// Oriented binary descriptors of corners: 256 comparisons of smoothed grey values (Calonder et al. 2010,
// BRIEF), in the frame of the patch's intensity centroid (Rublee et al. 2011, ORB). The comparisons are drawn
// by our own generator.
#pragma once

#include <array>
#include <cstdint>

#include "core/geometry/geometry.hpp"
#include "core/image_view/image_view.hpp"

namespace traygauge {

inline constexpr int kBinaryPatchRadius = 10;  // px; corners closer to the picture's edge have no descriptor
inline constexpr int kBinaryTurns = 32;  // steps of 11 degrees that the comparisons are turned by (ORB: 12)

using BinaryDescriptor = std::array<std::uint64_t, 4>;

// Bits that differ in the words `first` to `end`. Counted in bytes that are added up once: a processor that
// is not known to count bits would be asked for each word by a call.
inline int hamming_distance(const BinaryDescriptor& a, const BinaryDescriptor& b, std::size_t first,
                            std::size_t end) {
  std::uint64_t bytes = 0;
  for (std::size_t i = first; i < end; ++i) {
    std::uint64_t bits = a[i] ^ b[i];
    bits -= bits >> 1U & 0x5555555555555555U;
    bits = (bits & 0x3333333333333333U) + (bits >> 2U & 0x3333333333333333U);
    bytes += (bits + (bits >> 4U)) & 0x0F0F0F0F0F0F0F0FU;
  }
  // At most 32 a byte; all eight together may need more than a byte.
  const std::uint64_t pairs = (bytes & 0x00FF00FF00FF00FFU) + (bytes >> 8U & 0x00FF00FF00FF00FFU);
  return static_cast<int>(pairs * 0x0001000100010001U >> 48U);
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
