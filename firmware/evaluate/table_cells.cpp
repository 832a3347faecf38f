#include "firmware/evaluate/table_cells.hpp"

#include <cmath>

#include "firmware/base/text.hpp"
#include "simulator/capture/input_error.hpp"

namespace traygauge {

std::string cell(double value, int decimals) {
  return std::isnan(value) ? kNoValue : fixed(value, decimals);
}

std::string signed_cell(double value, int decimals) {
  const std::string text = cell(value, decimals);
  return value > 0.0 && text.find_first_not_of("0.") != std::string::npos ? "+" + text : text;
}

std::string shorten(const std::string& name, std::size_t width) {
  std::string text = printable(name);
  if (count_characters(text) <= width) return text;
  std::size_t begin = text.size();
  for (std::size_t kept = 0; begin > 0 && kept + 1 < width;) {
    --begin;
    if ((static_cast<unsigned char>(text[begin]) & 0xC0U) != 0x80U) ++kept;
  }
  return "…" + text.substr(begin);
}

std::string table_row(const std::string& name, std::size_t name_width, const std::vector<std::string>& cells,
                      std::size_t width) {
  std::string text = pad_right(shorten(name, name_width - 1), name_width);
  for (const std::string& value : cells) text += pad_left(value, width);
  return text + "\n";
}

}  // namespace traygauge
