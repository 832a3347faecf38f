#include "core/paper/stereo/census.hpp"

#include <algorithm>

namespace traygauge::paper {
namespace {

// Bits set in each pair of neighbouring bits, then in each nibble.
ByteLanes count_in_nibbles(ByteLanes bits) {
  const ByteLanes pairs = bits - ((bits >> 1) & 0x55);
  return (pairs & 0x33) + ((pairs >> 2) & 0x33);
}

// The differences of three bytes are added by a full adder before they are counted: at most 12 a nibble.
ByteLanes count_three(ByteLanes a, ByteLanes b, ByteLanes c) {
  const ByteLanes half = a ^ b;
  const ByteLanes ones = half ^ c;
  const ByteLanes twos = (a & b) | (half & c);
  return count_in_nibbles(ones) + (count_in_nibbles(twos) << 1);
}

ByteLanes add_nibbles(ByteLanes nibbles) {
  return (nibbles & 0x0f) + (nibbles >> 4);
}

template <int kBytes>
void hamming_distances(const ByteLanes* first, const ByteLanes* second, int count, ByteLanes* distances) {
  for (int k = 0; k < count; ++k, second += kBytes) {
    ByteLanes distance{};
    int i = 0;
    for (; i + 3 <= kBytes; i += 3) {
      distance += add_nibbles(
          count_three(first[i] ^ second[i], first[i + 1] ^ second[i + 1], first[i + 2] ^ second[i + 2]));
    }
    for (; i < kBytes; ++i) distance += add_nibbles(count_in_nibbles(first[i] ^ second[i]));
    distances[k] = distance;
  }
}

// Flipping the top bit orders unsigned pixels as signed ones, which every processor compares.
SignLanes ordered(const std::uint8_t* rows) {
  return reinterpret_cast<SignLanes>(load_lanes<ByteLanes>(rows) ^ 0x80);
}

}  // namespace

void transform_census(const BlockPicture& block, int radius_px, std::span<ByteLanes> codes) {
  const int bytes = census_bytes(radius_px);
  for (int x = 0; x < block.width; ++x) {
    ByteLanes* code = &codes[static_cast<std::size_t>(x) * static_cast<std::size_t>(bytes)];
    for (int i = 0; i < bytes; ++i) code[i] = ByteLanes{};
    const SignLanes centre = ordered(block.pixels[static_cast<std::size_t>(x)].row + kMaxCensusRadius);
    int bit = 0;
    for (int dx = -radius_px; dx <= radius_px; ++dx) {
      const auto column = static_cast<std::size_t>(std::clamp(x + dx, 0, block.width - 1));
      for (int dy = -radius_px; dy <= radius_px; ++dy) {
        if (dx == 0 && dy == 0) continue;
        const SignLanes neighbour = ordered(block.pixels[column].row + kMaxCensusRadius + dy);
        const auto greater = reinterpret_cast<ByteLanes>(neighbour > centre);
        code[bit / 8] |= greater & broadcast_byte(static_cast<std::uint8_t>(1 << (bit % 8)));
        ++bit;
      }
    }
  }
}

void hamming_distances(const ByteLanes* first, const ByteLanes* second, int radius_px, int count,
                       ByteLanes* distances) {
  static_assert(kMaxCensusRadius == 4);
  switch (radius_px) {
    case 1:
      return hamming_distances<census_bytes(1)>(first, second, count, distances);
    case 2:
      return hamming_distances<census_bytes(2)>(first, second, count, distances);
    case 3:
      return hamming_distances<census_bytes(3)>(first, second, count, distances);
    default:
      return hamming_distances<census_bytes(4)>(first, second, count, distances);
  }
}

}  // namespace traygauge::paper
