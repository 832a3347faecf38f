#include "firmware/base/toml_text.hpp"

#include <array>
#include <charconv>

namespace traygauge {

std::string toml_number(double value) {
  std::array<char, 64> digits{};
  const char* end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  std::string text(digits.data(), static_cast<std::size_t>(end - digits.data()));
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string toml_text(const std::string& text) {
  constexpr const char* kHex = "0123456789abcdef";
  std::string basic = "\"";
  for (const char character : text) {
    const auto code = static_cast<unsigned char>(character);
    if (code < 0x20 || code == 0x7f) {
      basic += std::string("\\u00") + kHex[code / 16] + kHex[code % 16];
    } else {
      if (character == '"' || character == '\\') basic += '\\';
      basic += character;
    }
  }
  return basic + "\"";
}

}  // namespace traygauge
