#include "core/quality/item_pixels.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <numbers>

#include "core/base/units.hpp"

namespace traygauge {
namespace {

// A block's 16 cells leave 13 degrees of freedom beside a plane; a cell's mean has a quarter of a pixel's
// noise.
constexpr int kBlock_px = 16;
constexpr int kCell_px = 4;
constexpr int kCells = kBlock_px / kCell_px;
constexpr double kCellArea = kCell_px * kCell_px;

void count_clipped(ImageView<const std::uint8_t> gray, ImageView<const std::uint8_t> labels,
                   const PixelBox& box, const ItemPixelParams& params, ItemPixelTable& items) {
  for (int y = box.top; y < box.bottom; ++y) {
    const std::uint8_t* gray_row = gray.row(y);
    const std::uint8_t* label_row = labels.row(y);
    for (int x = box.left; x < box.right; ++x) {
      if (!is_item(label_row[x])) continue;
      ItemPixels& item = items[label_row[x]];
      ++item.pixels;
      if (gray_row[x] <= params.crushed_level || gray_row[x] >= kBurntGray) ++item.clipped;
    }
  }
}

template <class Action>
void for_each_block(const PixelBox& box, Action&& action) {
  for (int top = box.top; top + kBlock_px <= box.bottom; top += kBlock_px) {
    for (int left = box.left; left + kBlock_px <= box.right; left += kBlock_px) action(left, top);
  }
}

bool is_uniform(ImageView<const std::uint8_t> labels, int left, int top) {
  std::array<std::uint8_t, kBlock_px> expected{};
  expected.fill(labels.at(left, top));
  for (int y = top; y < top + kBlock_px; ++y) {
    if (std::memcmp(labels.row(y) + left, expected.data(), expected.size()) != 0) return false;
  }
  return true;
}

bool is_item_block(ImageView<const std::uint8_t> labels, int left, int top) {
  return is_item(labels.at(left, top)) && is_uniform(labels, left, top);
}

// Variance of the cells' means about their best plane: a shade that runs over the block is no texture.
double texture_variance(ImageView<const std::uint8_t> gray, int left, int top) {
  std::array<std::array<int, kCells>, kCells> sums{};
  for (int y = 0; y < kBlock_px; ++y) {
    const std::uint8_t* row = gray.row(top + y) + left;
    for (int x = 0; x < kBlock_px; ++x) {
      sums[static_cast<std::size_t>(y / kCell_px)][static_cast<std::size_t>(x / kCell_px)] += row[x];
    }
  }
  std::int64_t sum = 0;
  std::int64_t squares = 0;
  std::int64_t along_x = 0;
  std::int64_t along_y = 0;
  for (int y = 0; y < kCells; ++y) {
    for (int x = 0; x < kCells; ++x) {
      const std::int64_t cell = sums[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)];
      sum += cell;
      squares += cell * cell;
      along_x += cell * (2 * x - kCells + 1);
      along_y += cell * (2 * y - kCells + 1);
    }
  }
  constexpr int kPlaneMoment =
      kCells * kCells * (kCells * kCells - 1) / 3;  // Σ (2 x − kCells + 1)² over the cells
  const double rest = static_cast<double>(squares) - static_cast<double>(sum * sum) / (kCells * kCells) -
                      static_cast<double>(along_x * along_x + along_y * along_y) / kPlaneMoment;
  return std::max(0.0, rest) / (kCells * kCells - 3) / (kCellArea * kCellArea);
}

// Immerkær, Fast noise variance estimation (1996): the mask leaves nothing of planes and straight edges.
double noise_deviation(ImageView<const std::uint8_t> gray, int left, int top) {
  int sum = 0;
  for (int y = top + 1; y < top + kBlock_px - 1; ++y) {
    const std::uint8_t* above = gray.row(y - 1);
    const std::uint8_t* row = gray.row(y);
    const std::uint8_t* below = gray.row(y + 1);
    for (int x = left + 1; x < left + kBlock_px - 1; ++x) {
      sum += std::abs(above[x - 1] - 2 * above[x] + above[x + 1] - 2 * row[x - 1] + 4 * row[x] -
                      2 * row[x + 1] + below[x - 1] - 2 * below[x] + below[x + 1]);
    }
  }
  constexpr double kSamples = (kBlock_px - 2) * (kBlock_px - 2);
  return std::sqrt(0.5 * std::numbers::pi) / 6.0 * sum / kSamples;
}

bool is_textured(ImageView<const std::uint8_t> gray, int left, int top, const ItemPixelParams& params) {
  const double variance = texture_variance(gray, left, top);
  if (variance < params.min_texture * params.min_texture) return false;
  const double noise = params.min_texture_over_noise * noise_deviation(gray, left, top) / kCell_px;
  return variance >= noise * noise;
}

}  // namespace

void measure_item_pixels(ImageView<const std::uint8_t> gray, ImageView<const std::uint8_t> labels,
                         const PixelBox& dish, const ItemPixelParams& params, ItemPixelTable& items) {
  items.fill({});
  count_clipped(gray, labels, dish, params, items);
  for_each_block(dish, [&](int left, int top) {
    if (!is_item_block(labels, left, top)) return;
    ItemPixels& item = items[labels.at(left, top)];
    ++item.blocks;
    if (is_textured(gray, left, top, params)) ++item.textured;
  });
}

void count_blank_blocks(const std::array<ImageView<const std::uint8_t>, 2>& grays,
                        const std::array<ImageView<const std::uint8_t>, 2>& labels, const PixelBox& dish,
                        const ItemPixelParams& params, BlankBlockTable& blank) {
  assert(grays[0].width == grays[1].width && grays[0].height == grays[1].height);
  blank.fill(0);
  for_each_block(dish, [&](int left, int top) {
    const auto is_blank = [&](std::size_t v) {
      return is_item_block(labels[v], left, top) && !is_textured(grays[v], left, top, params);
    };
    if (is_blank(0) && is_blank(1)) ++blank[labels[0].at(left, top)];
  });
}

}  // namespace traygauge
