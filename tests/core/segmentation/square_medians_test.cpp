#include "core/segmentation/square_medians.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

namespace traygauge {
namespace {

// Against sorting, on random fields of few and of many values.
TEST(SquareMedians, AreThoseOfSortedSquares) {
  for (unsigned seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const int width = 1 + static_cast<int>(random() % 23U);
    const int height = 1 + static_cast<int>(random() % 19U);
    const int radius = static_cast<int>(random() % 5U);
    const unsigned values = seed % 3U == 0 ? 3U : 256U;
    std::vector<std::uint8_t> field(static_cast<std::size_t>(width * height));
    for (std::uint8_t& value : field) value = static_cast<std::uint8_t>(random() % values);
    const auto at = [&](int x, int y) { return field[static_cast<std::size_t>(y * width + x)]; };
    int taken = 0;
    for_each_square_median(width, height, radius, at, [&](int x, int y, std::uint8_t median) {
      std::vector<std::uint8_t> square;
      for (int j = std::max(0, y - radius); j <= std::min(height - 1, y + radius); ++j) {
        for (int i = std::max(0, x - radius); i <= std::min(width - 1, x + radius); ++i)
          square.push_back(at(i, j));
      }
      std::sort(square.begin(), square.end());
      EXPECT_EQ(median, square[(square.size() - 1) / 2]) << x << " " << y;
      ++taken;
    });
    EXPECT_EQ(taken, width * height);
  }
}

}  // namespace
}  // namespace traygauge
