// Numbers in files: the lowest byte first, whatever the processor.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

namespace traygauge {

template <std::integral T>
void store_little_endian(std::span<std::byte> bytes, std::size_t at, T number) {
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    bytes[at + i] = static_cast<std::byte>((static_cast<std::uint64_t>(number) >> (8 * i)) & 0xff);
  }
}

template <std::integral T>
T load_little_endian(std::span<const std::byte> bytes, std::size_t at) {
  std::uint64_t number = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    number |= std::to_integer<std::uint64_t>(bytes[at + i]) << (8 * i);
  }
  return static_cast<T>(number);
}

}  // namespace traygauge
