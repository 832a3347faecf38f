// Chessboards in pictures.
#pragma once

#include <string>
#include <vector>

#include "core/geometry/geometry.hpp"
#include "core/image_view/image_view.hpp"

namespace traygauge {

// Inner corners, where four fields meet.
struct Chessboard {
  int columns = 0;
  int rows = 0;

  std::size_t corner_count() const {
    return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  }
  // Row by row, in fields: how large they are does not matter to the lens.
  Vec2 corner_place(std::size_t index) const {
    const auto width = static_cast<std::size_t>(columns);
    const std::size_t row = index / width;
    return {static_cast<double>(index - row * width), static_cast<double>(row)};
  }
};

// The corners of one board in one picture, row by row, pixels.
struct BoardSighting {
  std::string picture;
  std::vector<Vec2> corners_px;
};

// False when the whole board is not seen. The corners may begin at either end of the board: that changes
// where the board lies, not the lens. They never run mirrored.
bool find_chessboard(ImageView<const std::uint8_t> gray, const Chessboard& board, BoardSighting& sighting);

}  // namespace traygauge
