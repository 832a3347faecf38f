// Text for people.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace traygauge {

// A number with a fixed count of decimals; never a negative zero.
std::string fixed(double number, int decimals);

// Bytes in MiB, two decimals.
std::string mebibytes(std::size_t bytes);

// Of UTF-8, by character.
std::size_t count_characters(const std::string& text);

// Padded with spaces to `width` characters; the text stands right or left.
std::string pad_left(const std::string& text, std::size_t width);
std::string pad_right(const std::string& text, std::size_t width);

// Numbers with an x between, as people write sizes: "85.4x53.9x1.0", also with decimal commas. Empty where
// the text is anything else.
std::vector<double> read_sizes(const std::string& text);

}  // namespace traygauge
