// Cells and rows of tables on a terminal.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace traygauge {

inline constexpr std::size_t kNameWidth = 20;
inline constexpr std::size_t kCellWidth = 9;
inline constexpr const char* kNoValue = "–";

// kNoValue for NaN.
std::string cell(double value, int decimals);
// With a plus before what is positive.
std::string signed_cell(double value, int decimals);

// At most `width` characters: the end of a name says more than its beginning, which is a folder.
std::string shorten(const std::string& name, std::size_t width);

std::string table_row(const std::string& name, std::size_t name_width, const std::vector<std::string>& cells,
                      std::size_t width);

}  // namespace traygauge
