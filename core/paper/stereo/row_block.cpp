#include "core/paper/stereo/row_block.hpp"

#include <algorithm>

namespace traygauge::paper {
namespace {

bool has_masked_row(ByteLanes inside) {
  std::uint8_t any = 0;
  for (int r = 0; r < kRowLanes; ++r) any = static_cast<std::uint8_t>(any | inside[r + kMaxWindowRadius]);
  return any != 0;
}

}  // namespace

void load_block(ImageView<const std::uint8_t> picture, ImageView<const std::uint8_t> mask, int top,
                BlockPicture& block) {
  block.width = picture.width;
  const auto width = static_cast<std::size_t>(picture.width);
  for (int r = 0; r < kPixelRows; ++r) {
    const int y = std::clamp(top + kFirstPixelRow + r, 0, picture.height - 1);
    const std::uint8_t* row = picture.row(y);
    for (std::size_t x = 0; x < width; ++x) block.pixels[x].row[r] = row[x];
  }
  for (int r = 0; r < kCostRows; ++r) {
    const int y = top - kMaxWindowRadius + r;
    const std::uint8_t* row = y >= 0 && y < mask.height ? mask.row(y) : nullptr;
    for (std::size_t x = 0; x < width; ++x) block.inside[x][r] = row != nullptr && row[x] != 0 ? 0xff : 0;
  }
}

Interval masked_columns(const BlockPicture& block) {
  Interval columns{0, block.width - 1};
  while (!columns.empty() && !has_masked_row(block.inside[static_cast<std::size_t>(columns.lo)]))
    ++columns.lo;
  while (!columns.empty() && !has_masked_row(block.inside[static_cast<std::size_t>(columns.hi)]))
    --columns.hi;
  return columns;
}

}  // namespace traygauge::paper
