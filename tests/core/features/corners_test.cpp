// The corner response against OpenCV's, and what the buckets promise.
#include <gtest/gtest.h>

#include <array>
#include <opencv2/imgproc.hpp>
#include <set>
#include <vector>

#include "core/features/corners.hpp"
#include "tests/support/allocated.hpp"
#include "tests/support/pictures.hpp"

namespace traygauge {
namespace {

using test::view_of;

TEST(CornerResponse, EqualsOpenCvsSmallerEigenvalue) {
  const cv::Mat gray = test::textured_picture(211, 97, 3);
  cv::Mat1f oracle;
  constexpr int kWindow = 2 * kCornerWindowRadius + 1;
  cv::cornerMinEigenVal(gray, oracle, kWindow, 3);
  // OpenCV scales 8-bit gradients by 1 / (255 · 4 · window) and adds up over the window; its Sobel is 4 times
  // a mean difference of two pixels, ours counts per pixel and averages.
  const double scale = 255.0 * 255.0 * 16.0 * kWindow * kWindow / (64.0 * kWindow * kWindow);
  test::Allocated<CornerResponseWorkspace> memory(gray.cols);
  CornerResponse response(view_of(gray), *memory);
  std::vector<float> row(static_cast<std::size_t>(gray.cols));
  double strongest = 0.0;
  for (int y = response.first_row(); y < response.end_row(); ++y) {
    response.next_row(row);
    for (int x = kCornerBorder; x < gray.cols - kCornerBorder; ++x) {
      const double expected = scale * static_cast<double>(oracle(y, x));
      ASSERT_NEAR(row[static_cast<std::size_t>(x)], expected, 1e-3 + 1e-4 * expected) << x << ", " << y;
      strongest = std::max(strongest, expected);
    }
  }
  EXPECT_GT(strongest, 10.0);
}

class Corners : public ::testing::Test {
 protected:
  static constexpr int kWidth = 320;
  static constexpr int kHeight = 240;

  Corners() : storage_(1000), labels_(2 * kHeight, 2 * kWidth, std::uint8_t{0}) {
    gray_ = test::textured_picture(kWidth, kHeight, 5);
  }
  std::vector<Corner> find(std::uint64_t seed, std::span<const std::uint8_t> hidden = {}) {
    test::Allocated<CornerWorkspace> memory(kWidth, kHeight, params_);
    BoundedList<Corner> corners{std::span<Corner>(storage_)};
    Random random(seed);
    find_corners({view_of(gray_), view_of(labels_), 2, hidden}, params_, random, *memory, corners);
    return {corners.begin(), corners.end()};
  }
  static std::set<std::pair<int, int>> places(const std::vector<Corner>& corners) {
    std::set<std::pair<int, int>> result;
    for (const Corner& corner : corners) result.insert({corner.x, corner.y});
    return result;
  }

  CornerParams params_;
  cv::Mat gray_;
  std::vector<Corner> storage_;
  cv::Mat1b labels_;
};

TEST_F(Corners, AreSpreadOverTheCells) {
  params_.corners_per_bucket = 3;
  std::array<int, (kWidth / 32 + 1) * (kHeight / 32 + 1)> count{};
  const CornerGrid grid(kWidth, kHeight, params_);
  for (const Corner& corner : find(1)) ++count[grid.cell_of(corner.x, corner.y)];
  for (int row = 0; row < grid.rows - 1; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const int in_cell = count[grid.cell_of(column * grid.cell_px, row * grid.cell_px)];
      EXPECT_GE(in_cell, 1) << column << ", " << row;
      EXPECT_LE(in_cell, 3) << column << ", " << row;
    }
  }
}

TEST_F(Corners, OfAnotherSeedAreOthersAndOfTheSameSeedTheSame) {
  params_.corners_per_bucket = 3;
  const auto first = places(find(1));
  EXPECT_EQ(first, places(find(1)));
  const auto second = places(find(2));
  std::size_t shared = 0;
  for (const auto& place : first) shared += second.count(place);
  EXPECT_LT(shared, first.size() * 7 / 10);
}

TEST_F(Corners, KeepAwayFromTheNextGround) {
  cv::circle(labels_, {kWidth, kHeight}, 150, kDishLabel, cv::FILLED);
  cv::circle(labels_, {kWidth, kHeight}, 60, 7, cv::FILLED);
  std::array<int, kGrounds> count{};
  for (const Corner& corner : find(1)) {
    const double distance = std::hypot(2.0 * corner.x + 0.5 - kWidth, 2.0 * corner.y + 0.5 - kHeight);
    EXPECT_GT(std::abs(distance - 150.0), 0.8 * params_.label_margin_px);
    EXPECT_GT(std::abs(distance - 60.0), 0.8 * params_.label_margin_px);
    EXPECT_EQ(corner.label, distance > 150.0 ? 0 : distance > 60.0 ? kDishLabel : 7);
    ++count[static_cast<std::size_t>(ground_of(corner.label))];
  }
  EXPECT_GT(count[static_cast<std::size_t>(Ground::table)], 50);
  EXPECT_GT(count[static_cast<std::size_t>(Ground::dish)], 20);
  EXPECT_GT(count[static_cast<std::size_t>(Ground::food)], 5);
}

TEST_F(Corners, AreNotInHiddenCellsHighlightsOrNoise) {
  cv::rectangle(gray_, {100, 100, 60, 60}, 0, cv::FILLED);
  cv::rectangle(gray_, {110, 110, 40, 40}, 255, cv::FILLED);
  const CornerGrid grid(kWidth, kHeight, params_);
  std::vector<std::uint8_t> hidden(grid.cells());
  hidden[0] = 1;
  for (const Corner& corner : find(1, hidden)) {
    EXPECT_NE(grid.cell_of(corner.x, corner.y), 0U);
    EXPECT_FALSE(corner.x > 107 && corner.x < 152 && corner.y > 107 && corner.y < 152);
  }
  // White noise of two grey values at full size has one at half size.
  cv::RNG rng(3);
  cv::Mat noise(kHeight, kWidth, CV_8S);
  rng.fill(noise, cv::RNG::NORMAL, 0.0, 1.0);
  noise.convertTo(gray_, CV_8U, 1.0, 128.0);
  EXPECT_TRUE(find(1).empty());
}

TEST_F(Corners, OfATinyPictureAreNone) {
  gray_ = gray_(cv::Rect(0, 0, 8, 8)).clone();
  labels_ = cv::Mat1b(16, 16, std::uint8_t{0});
  EXPECT_TRUE(find(1).empty());
}

}  // namespace
}  // namespace traygauge
