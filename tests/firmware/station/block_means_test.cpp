#include "firmware/station/block_means.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace traygauge {
namespace {

constexpr int kWidth = 160;
constexpr int kHeight = 130;  // the last row of blocks is cut

class BlockMeansOfPictures : public testing::Test {
 protected:
  using Pixels = std::vector<std::uint8_t>;

  // A checkerboard of squares of 24 px, moved to the right.
  static Pixels board(int moved_px) {
    Pixels pixels(3U * kWidth * kHeight);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const bool is_bright = ((x + 240 - moved_px) / 24 + y / 24) % 2 == 0;
        std::fill_n(pixels.begin() + 3 * (y * kWidth + x), 3,
                    static_cast<std::uint8_t>(is_bright ? 150 : 60));
      }
    }
    return pixels;
  }
  static bool agree(const Pixels& first, const Pixels& second, int second_width = kWidth) {
    BlockMeans a;
    BlockMeans b;
    a.compute({first.data(), kWidth, kHeight, 3 * kWidth, PixelFormat::bgr8});
    b.compute({second.data(), second_width, kHeight, 3 * kWidth, PixelFormat::bgr8});
    return a.agrees_with(b, SteadinessParams{});
  }
};

TEST_F(BlockMeansOfPictures, AgreeUnderNoiseAndFlicker) {
  std::mt19937 random(1);
  Pixels noisy = board(0);
  std::normal_distribution<double> noise(0.0, 12.0);
  for (std::uint8_t& value : noisy) value = static_cast<std::uint8_t>(1.05 * value + noise(random));
  EXPECT_TRUE(agree(board(0), board(0)));
  EXPECT_TRUE(agree(board(0), noisy));
}

TEST_F(BlockMeansOfPictures, DifferWhenTheSceneMovedOrAFewRowsAreOfAnother) {
  EXPECT_FALSE(agree(board(0), board(8)));
  for (const int rows : {6, 65, 124}) {
    Pixels mixed = board(0);
    const Pixels other = board(24);
    std::copy(other.begin(), other.begin() + 3 * rows * kWidth, mixed.begin());
    EXPECT_FALSE(agree(board(0), mixed)) << rows;
  }
}

TEST_F(BlockMeansOfPictures, DifferInSizeOrWithoutAPicture) {
  EXPECT_FALSE(agree(board(0), board(0), kWidth - 1));
  EXPECT_FALSE(BlockMeans().agrees_with(BlockMeans(), SteadinessParams{}));
}

TEST_F(BlockMeansOfPictures, AreTheMeansOfTheirPixels) {
  Pixels pixels = board(0);
  const Pixels before = pixels;
  // One block of 256 pixels, brighter by 17 everywhere: one of 90 blocks, above the share of 0.2 %.
  for (int y = 16; y < 32; ++y) {
    for (int i = 3 * 16; i < 3 * 32; ++i) pixels[static_cast<std::size_t>(3 * y * kWidth + i)] += 17;
  }
  EXPECT_FALSE(agree(before, pixels));
  for (int i = 3 * 16; i < 3 * 32; ++i) pixels[static_cast<std::size_t>(3 * 16 * kWidth + i)] -= 17;
  EXPECT_TRUE(agree(before, pixels));  // 15.9 on average
}

}  // namespace
}  // namespace traygauge
