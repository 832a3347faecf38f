// Points that fill a unit square evenly, different for every pixel and every decision on a path.
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace traygauge {

constexpr std::uint32_t hash_of(std::uint32_t x) {
  x ^= x >> 16U;
  x *= 0x7feb352dU;
  x ^= x >> 15U;
  x *= 0x846ca68bU;
  x ^= x >> 16U;
  return x;
}

constexpr std::uint32_t hash_of(std::uint32_t x, std::uint32_t y) {
  return hash_of(x ^ hash_of(y + 0x9e3779b9U));
}

constexpr std::uint32_t hash_of(std::uint64_t x) {
  return hash_of(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(x >> 32U));
}

// Sobol's first two dimensions with Owen's scrambling by hash (Burley 2020, Practical hash-based Owen
// scrambling; constants of Vegdahl). Any 2^k points from a multiple of 2^k on are a (0, k, 2)-net.
class SampleSequence {
 public:
  constexpr explicit SampleSequence(std::uint32_t seed) : seed_(seed) {}

  // `decision`: which square; `index`: which of its points. In [0, 1)².
  Eigen::Vector2f point(std::uint32_t decision, std::uint32_t index) const {
    const std::uint32_t seed = hash_of(seed_, decision);
    const std::uint32_t shuffled = reversed(permuted(reversed(index), seed));
    const std::uint32_t x = reversed(permuted(shuffled, hash_of(seed + 1U)));
    const std::uint32_t y = reversed(permuted(second_dimension_reversed(shuffled), hash_of(seed + 2U)));
    return {unit(x), unit(y)};
  }

 private:
  static constexpr std::uint32_t reversed(std::uint32_t x) {
    x = ((x >> 1U) & 0x55555555U) | ((x & 0x55555555U) << 1U);
    x = ((x >> 2U) & 0x33333333U) | ((x & 0x33333333U) << 2U);
    x = ((x >> 4U) & 0x0f0f0f0fU) | ((x & 0x0f0f0f0fU) << 4U);
    return __builtin_bswap32(x);
  }

  // Each bit is flipped by a function of the bits below it (Laine and Karras 2011).
  static constexpr std::uint32_t permuted(std::uint32_t x, std::uint32_t seed) {
    x ^= x * 0x3d20adeaU;
    x += seed;
    x *= (seed >> 16U) | 1U;
    x ^= x * 0x05526c56U;
    x ^= x * 0x53a22864U;
    return x;
  }

  // Bit j of the result is the parity of those bits k of the index for which the binomial (k over j) is odd:
  // of all k that have the bits of j (Lucas).
  static constexpr std::uint32_t second_dimension_reversed(std::uint32_t index) {
    index ^= (index >> 1U) & 0x55555555U;
    index ^= (index >> 2U) & 0x33333333U;
    index ^= (index >> 4U) & 0x0f0f0f0fU;
    index ^= (index >> 8U) & 0x00ff00ffU;
    index ^= index >> 16U;
    return index;
  }

  static constexpr float unit(std::uint32_t x) { return static_cast<float>(x >> 8U) * 0x1p-24F; }

  std::uint32_t seed_;
};

}  // namespace traygauge
