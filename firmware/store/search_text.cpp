#include "firmware/store/search_text.hpp"

#include <cstddef>

namespace traygauge {

std::string fold_case(std::string_view text) {
  // U+00C0 to U+00DE are 0xC3 with 0x80 to 0x9E; their lower case lies 0x20 further. U+00D7 is the sign of
  // multiplication.
  constexpr char kLatinLead = '\xc3';
  constexpr unsigned char kTimes = 0x97;
  std::string folded(text);
  for (std::size_t i = 0; i < folded.size(); ++i) {
    const auto byte = static_cast<unsigned char>(folded[i]);
    const bool is_ascii_capital = byte >= 'A' && byte <= 'Z';
    const bool is_latin_capital =
        i > 0 && folded[i - 1] == kLatinLead && byte >= 0x80 && byte <= 0x9e && byte != kTimes;
    if (is_ascii_capital || is_latin_capital) folded[i] = static_cast<char>(byte + 0x20);
  }
  return folded;
}

}  // namespace traygauge
