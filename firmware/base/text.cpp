#include "firmware/base/text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <system_error>

namespace traygauge {
namespace {

std::string padding(const std::string& text, std::size_t width) {
  const std::size_t length = count_characters(text);
  std::string spaces(width > length ? width - length : 0, ' ');
  return spaces;
}

}  // namespace

std::string fixed(double number, int decimals) {
  std::array<char, 400> buffer{};  // the largest double has 309 digits
  std::snprintf(buffer.data(), buffer.size(), "%.*f", decimals, number);
  const std::string text = buffer.data();
  const bool is_zero = text.find_first_not_of("-0.") == std::string::npos;
  return is_zero && text[0] == '-' ? text.substr(1) : text;
}

std::string mebibytes(std::size_t bytes) {
  constexpr double bytes_per_mebibyte = 1024.0 * 1024.0;
  return fixed(static_cast<double>(bytes) / bytes_per_mebibyte, 2);
}

std::size_t count_characters(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::string pad_left(const std::string& text, std::size_t width) {
  return padding(text, width) + text;
}

std::string pad_right(const std::string& text, std::size_t width) {
  return text + padding(text, width);
}

std::vector<double> read_sizes(const std::string& text) {
  std::vector<double> numbers;
  std::string plain = text;
  std::replace(plain.begin(), plain.end(), ',', '.');
  const char* at = plain.data();
  const char* const end = at + plain.size();
  while (true) {
    double number = 0.0;
    const auto [stop, error] = std::from_chars(at, end, number, std::chars_format::fixed);
    if (error != std::errc() || !std::isfinite(number)) return {};
    numbers.push_back(number);
    if (stop == end) return numbers;
    if (*stop != 'x' && *stop != 'X') return {};
    at = stop + 1;
  }
}

}  // namespace traygauge
