// Captures of whole fruit from photographs of it on a page of markers (real/fruit_board_*): one for each pair
// of views, so that fruit goes through all of the product. Four markers are the card, a disc of the page is
// the dish, and the fruit's silhouettes are its labels.
#pragma once

#include <cstddef>
#include <filesystem>

namespace traygauge {

struct BoardFruit {
  double closed_ml = 0.0;  // for truth.json, as the photographs' README has them
  double column_ml = 0.0;  // under the upper surface
};

// Of `board`'s pairs of 10 to 28 degrees those that both show four markers which the fruit leaves free: of
// all such, the flattest. Returns how many captures were written into `set`.
std::size_t write_fruit_captures(const std::filesystem::path& board, const BoardFruit& fruit,
                                 const std::filesystem::path& set);

}  // namespace traygauge
