// Sixteen binary descriptors side by side, of which the first half is compared with another at once.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <tuple>

#include "core/features/binary_descriptor.hpp"

namespace traygauge {

inline constexpr std::size_t kHalfWords = std::tuple_size_v<BinaryDescriptor> / 2;
inline constexpr std::size_t kHalfBytes = kHalfWords * sizeof(std::uint64_t);

class DescriptorBlock {
 public:
  static constexpr std::size_t kSide = 16;  // descriptors

  // Sixteen bytes for one descriptor each, or sixteen times the same.
  using Lanes [[gnu::vector_size(16)]] = std::uint64_t;
  // The bytes of a half, each as often as the block has descriptors.
  using Spread = std::array<Lanes, kHalfBytes>;
  using Distances = std::array<std::uint8_t, kSide>;

  static Spread spread(const BinaryDescriptor& descriptor) {
    Spread spread;
    for (std::size_t byte = 0; byte < kHalfBytes; ++byte) {
      const std::uint64_t eight = 0x0101010101010101U * byte_of(descriptor, byte);
      spread[byte] = Lanes{eight, eight};
    }
    return spread;
  }

  void set(std::size_t place, const BinaryDescriptor& descriptor) {
    for (std::size_t byte = 0; byte < kHalfBytes; ++byte) {
      const auto value = static_cast<std::uint8_t>(byte_of(descriptor, byte));
      std::memcpy(reinterpret_cast<std::byte*>(&rows_[byte]) + place, &value, 1);
    }
  }

  // Bits of the first half that differ, for each descriptor. Bits of one weight are added three at a time,
  // which leaves few bytes whose bits have to be counted.
  Distances distances(const Spread& spread) const {
    Lanes ones{};
    Lanes twos{};
    Lanes fours{};
    Lanes eights{};
    Lanes sixteens{};
    for (std::size_t i = 0; i < kHalfBytes; i += 8) {
      const auto differ = [&](std::size_t byte) { return rows_[i + byte] ^ spread[i + byte]; };
      Lanes carry = add(ones, differ(0), differ(1));
      Lanes pair = add(twos, carry, add(ones, differ(2), differ(3)));
      carry = add(ones, differ(4), differ(5));
      pair = add(fours, pair, add(twos, carry, add(ones, differ(6), differ(7))));
      sixteens |= eights & pair;
      eights ^= pair;
    }
    const Lanes sum = count_bits(ones) + (count_bits(twos) << 1) + (count_bits(fours) << 2) +
                      (count_bits(eights) << 3) + (count_bits(sixteens) << 4);
    Distances distances;
    static_assert(sizeof(sum) == sizeof(distances));
    std::memcpy(distances.data(), &sum, sizeof(sum));
    return distances;
  }

 private:
  static_assert(kHalfBytes == 16, "sixteens take one carry only");

  static std::uint64_t byte_of(const BinaryDescriptor& descriptor, std::size_t byte) {
    return descriptor[byte / 8] >> (8 * (byte % 8)) & 0xFFU;
  }
  // A full adder: `sum` keeps its weight, the carry has twice as much.
  static Lanes add(Lanes& sum, Lanes a, Lanes b) {
    const Lanes either = sum ^ a;
    const Lanes carry = (sum & a) | (either & b);
    sum = either ^ b;
    return carry;
  }
  static Lanes all(std::uint64_t value) { return Lanes{value, value}; }
  // Of every byte.
  static Lanes count_bits(Lanes bits) {
    bits -= (bits >> 1) & all(0x5555555555555555U);
    bits = (bits & all(0x3333333333333333U)) + ((bits >> 2) & all(0x3333333333333333U));
    return (bits + (bits >> 4)) & all(0x0F0F0F0F0F0F0F0FU);
  }

  std::array<Lanes, kHalfBytes> rows_{};  // byte by byte, in each row one of every descriptor
};

}  // namespace traygauge
