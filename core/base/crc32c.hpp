// The checksum CRC-32C (Castagnoli), as iSCSI (RFC 3720) and ext4 use it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace traygauge {

// The remainders of single bytes.
constexpr std::array<std::uint32_t, 256> crc32c_table() {
  constexpr std::uint32_t kPolynomial = 0x82f63b78;  // x^32 + x^28 + … + 1, lowest power in the highest bit
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t byte = 0; byte < table.size(); ++byte) {
    std::uint32_t remainder = byte;
    for (int bit = 0; bit < 8; ++bit) {
      remainder = (remainder >> 1) ^ ((remainder & 1) != 0 ? kPolynomial : 0);
    }
    table[byte] = remainder;
  }
  return table;
}

// Of bytes that come in pieces.
class Crc32c {
 public:
  void add(std::span<const std::byte> bytes) {
    static constexpr std::array<std::uint32_t, 256> kTable = crc32c_table();
    for (const std::byte byte : bytes) {
      remainder_ = (remainder_ >> 8) ^ kTable[(remainder_ ^ std::to_integer<std::uint32_t>(byte)) & 0xff];
    }
  }
  std::uint32_t value() const { return ~remainder_; }

 private:
  std::uint32_t remainder_ = ~std::uint32_t{0};
};

// Finds every change within 32 neighbouring bits, and of all others all but one in 2^32.
inline std::uint32_t crc32c(std::span<const std::byte> bytes) {
  Crc32c checksum;
  checksum.add(bytes);
  return checksum.value();
}

}  // namespace traygauge
