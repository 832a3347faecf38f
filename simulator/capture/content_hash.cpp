#include "simulator/capture/content_hash.hpp"

#include <array>
#include <cstddef>

namespace traygauge {

std::string content_hash(std::span<const std::uint8_t> bytes) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const std::uint8_t byte : bytes) hash = (hash ^ byte) * 0x100000001b3;
  constexpr std::array<char, 17> digits = {"0123456789abcdef"};
  std::string text(16, '0');
  for (std::size_t i = 0; i < text.size(); ++i) text[i] = digits.at((hash >> (60U - 4U * i)) & 15U);
  return text;
}

std::string content_hash(const std::string& text) {
  return content_hash(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

}  // namespace traygauge
