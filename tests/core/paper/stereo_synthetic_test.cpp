// Scenes whose disparity is known in closed form.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/core/paper/stereo_scene.hpp"

namespace traygauge::paper {
namespace {

using test::match;
using test::Matcher;
using test::random_texture;
using test::TestPair;

constexpr int kSceneWidth = 240;
constexpr int kSceneHeight = 120;
constexpr int kBorder = 8;  // pixels whose windows leave the picture

// The first picture of a second one under the disparity field d(x, y): first(x) = second(x + d).
template <class Field>
cv::Mat_<std::uint8_t> warp(const cv::Mat_<std::uint8_t>& second, int width, Field&& field) {
  cv::Mat_<float> columns(second.rows, width);
  cv::Mat_<float> rows(second.rows, width);
  for (int y = 0; y < second.rows; ++y) {
    for (int x = 0; x < width; ++x) {
      columns(y, x) = static_cast<float>(x + field(x, y));
      rows(y, x) = static_cast<float>(y);
    }
  }
  cv::Mat_<std::uint8_t> first;
  cv::remap(second, first, columns, rows, cv::INTER_CUBIC);
  return first;
}

class EachCost : public ::testing::TestWithParam<MatchingCost> {
 protected:
  StereoParams params() const {
    StereoParams params;
    params.cost = GetParam();
    return params;
  }
};
INSTANTIATE_TEST_SUITE_P(Synthetic, EachCost,
                         ::testing::Values(MatchingCost::census, MatchingCost::sad, MatchingCost::zncc));

TEST_P(EachCost, FindsShiftsToThePixel) {
  for (const int shift : {-37, -1, 0, 12, 40}) {
    const auto wide = random_texture(kSceneWidth + 80, kSceneHeight, 11);
    const cv::Mat_<std::uint8_t> second = wide(cv::Rect(40, 0, kSceneWidth, kSceneHeight)).clone();
    const cv::Mat_<std::uint8_t> first = wide(cv::Rect(40 + shift, 0, kSceneWidth, kSceneHeight)).clone();
    const auto disparity = match({first, second}, {-45, 45}, params());
    int looked_at = 0;
    int wrong = 0;
    for (int y = 0; y < kSceneHeight; ++y) {
      for (int x = 0; x < kSceneWidth; ++x) {
        if (std::min(x, x + shift) < 2 * kBorder) continue;
        if (std::max(x, x + shift) >= kSceneWidth - 2 * kBorder) continue;
        ++looked_at;
        wrong += std::abs(disparity(y, x) - kDisparityScale * shift) > kDisparityScale / 2;
      }
    }
    EXPECT_LE(wrong, looked_at / 1000) << "shift " << shift;
  }
}

TEST_P(EachCost, SlantedPlanesAreFoundBetweenPixels) {
  const auto second = random_texture(kSceneWidth, kSceneHeight, 12);
  for (const double slope : {-0.12, 0.04, 0.15}) {
    const auto truth = [&](int x, int y) {
      return 3.0 + slope * (x - kSceneWidth / 2) + 0.05 * (y - kSceneHeight / 2);
    };
    const auto disparity = match({warp(second, kSceneWidth, truth), second}, {-30, 36}, params());
    std::vector<double> errors;
    double sum = 0.0;
    for (int y = kBorder; y < kSceneHeight - kBorder; ++y) {
      for (int x = 2 * kBorder; x < kSceneWidth - 2 * kBorder; ++x) {
        if (x + truth(x, y) < kBorder || x + truth(x, y) > kSceneWidth - kBorder) continue;
        const double error = disparity(y, x) / double{kDisparityScale} - truth(x, y);
        errors.push_back(std::abs(error));
        sum += error;
      }
    }
    std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2),
                     errors.end());
    const double median = errors[errors.size() / 2];
    const double bias = sum / static_cast<double>(errors.size());
    std::printf("slope %+.2f: median error %.3f px, bias %+.4f px\n", slope, median, bias);
    EXPECT_LE(median, 0.15);
    EXPECT_NEAR(bias, 0.0, 0.03);
  }
}

// A square in front of a ground. Seen from the second view it hides the ground on one side; those ground
// pixels have no partner and are left out.
TEST_P(EachCost, StepEdgesStayWithinTheWindow) {
  constexpr int kNear = 24;
  constexpr int kFar = 6;
  const cv::Rect square(90, 30, 60, 60);  // in the first picture
  const auto ground = random_texture(kSceneWidth + 40, kSceneHeight, 13);
  const auto front = random_texture(kSceneWidth + 40, kSceneHeight, 14);
  cv::Mat_<std::uint8_t> first = ground(cv::Rect(0, 0, kSceneWidth, kSceneHeight)).clone();
  cv::Mat_<std::uint8_t> second(kSceneHeight, kSceneWidth + 40, std::uint8_t{0});
  ground.colRange(0, kSceneWidth + 40 - kFar).copyTo(second.colRange(kFar, kSceneWidth + 40));
  front(square).copyTo(first(square));
  front(square).copyTo(second(square + cv::Point(kNear, 0)));
  const auto disparity = match({first, second}, {-4, 34}, params());
  int wrong = 0;
  int visible = 0;
  for (int y = kBorder; y < kSceneHeight - kBorder; ++y) {
    for (int x = kBorder; x < kSceneWidth - kBorder; ++x) {
      const bool in_front = square.contains({x, y});
      const bool hidden = !in_front && (square + cv::Point(kNear, 0)).contains({x + kFar, y});
      if (hidden) continue;
      ++visible;
      wrong += std::abs(disparity(y, x) - kDisparityScale * (in_front ? kNear : kFar)) > kDisparityScale;
    }
  }
  const double per_edge_pixel = wrong / (2.0 * (square.width + square.height));
  std::printf("wrong pixels beside the edge: %.2f px wide, %.2f %% of all\n", per_edge_pixel,
              100.0 * wrong / visible);
  EXPECT_LT(per_edge_pixel, 3.0);
}

TEST_P(EachCost, NothingIsMatchedOutsideTheFirstMask) {
  const auto texture = random_texture(kSceneWidth, kSceneHeight, 15);
  TestPair pair(texture, texture);
  cv::ellipse(pair.first_mask = 0, {kSceneWidth / 2, kSceneHeight / 2}, {90, 50}, 20, 0, 360, 255,
              cv::FILLED);
  const auto disparity = match(pair, {-10, 10}, params());
  for (int y = 0; y < kSceneHeight; ++y) {
    for (int x = 0; x < kSceneWidth; ++x) {
      if (pair.first_mask(y, x) == 0) {
        ASSERT_EQ(disparity(y, x), kNoDisparity);
      } else {
        ASSERT_NEAR(disparity(y, x), 0, kDisparityScale / 2) << x << ", " << y;
      }
    }
  }
}

TEST_P(EachCost, PartnersOutsideTheSecondMaskAreAvoided) {
  const auto texture = random_texture(kSceneWidth, kSceneHeight, 16);
  TestPair pair(texture, texture);
  pair.second_mask.colRange(100, kSceneWidth) = 0;
  const auto disparity = match(pair, {-20, 20}, params());
  for (int y = 0; y < kSceneHeight; ++y) {
    for (int x = 0; x < kSceneWidth; ++x) {
      if (x >= 120) {
        ASSERT_EQ(disparity(y, x), kNoDisparity) << x << ", " << y;  // the whole range falls outside
      } else {
        ASSERT_NE(disparity(y, x), kNoDisparity) << x << ", " << y;
      }
      if (x < 100 - 2 * kBorder) {
        ASSERT_NEAR(disparity(y, x), 0, kDisparityScale / 2) << x << ", " << y;
      }
    }
  }
}

TEST_P(EachCost, EmptyMasksAndTinyPicturesAreNoTrouble) {
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(3, 20), cv::Size(40, 2), cv::Size(17, 9)}) {
    const auto texture = random_texture(size.width, size.height, 17);
    TestPair pair(texture, texture);
    const auto found = match(pair, {-3, 3}, params());
    EXPECT_NE(found(0, 0), kNoDisparity);
    pair.first_mask = 0;
    const auto nothing = match(pair, {-3, 3}, params());
    EXPECT_EQ(cv::countNonZero(nothing != kNoDisparity), 0);
    pair.first_mask = 255;
    const auto outside = match(pair, {100, 110}, params());
    EXPECT_EQ(cv::countNonZero(outside != kNoDisparity), 0);
  }
}

// Any monotonous change of the grey values leaves the census as it is (paper III-B-2); the smoothness follows
// the first picture, so the change is made to the second.
TEST(Synthetic, CensusIgnoresBrightnessAndContrast) {
  const auto second = random_texture(kSceneWidth, kSceneHeight, 18);
  const auto first = warp(second, kSceneWidth, [](int x, int y) { return 5.0 + 0.1 * (x - 100) + 0.03 * y; });
  // Halved first, so that doubling neither clips nor merges values.
  cv::Mat_<std::uint8_t> dim;
  cv::Mat(second / 2 + 10).convertTo(dim, CV_8U);
  cv::Mat_<std::uint8_t> bright;
  cv::Mat(dim * 2 - 20).convertTo(bright, CV_8U);
  const auto before = match({first, dim}, {-20, 30});
  const auto after = match({first, bright}, {-20, 30});
  StereoParams one_level;
  one_level.levels = 1;  // the pyramid's rounded means are not monotonous to the last bit
  EXPECT_EQ(cv::countNonZero(match({first, dim}, {-20, 30}, one_level) !=
                             match({first, bright}, {-20, 30}, one_level)),
            0);
  int differing = 0;
  const int first_column = 50;  // all of these have a partner
  const int last_column = kSceneWidth - 50;
  for (int y = kBorder; y < kSceneHeight - kBorder; ++y) {
    for (int x = first_column; x < last_column; ++x) {
      differing += std::abs(before(y, x) - after(y, x)) > kDisparityScale / 2;
    }
  }
  EXPECT_LT(differing, (last_column - first_column) * (kSceneHeight - 2 * kBorder) / 500);
}

TEST(Synthetic, RefusesWhatExceedsTheWorkspace) {
  const StereoParams params;
  Matcher matcher(64, 32, 20, params);
  cv::Mat_<Disparity> disparity;
  const auto picture = random_texture(64, 32, 19);
  EXPECT_TRUE(matcher.match({picture, picture}, {0, 19}, disparity).ok());
  EXPECT_EQ(matcher.match({picture, picture}, {0, 20}, disparity).code(),
            StatusCode::disparity_range_too_large);
  EXPECT_EQ(matcher.match({picture, picture}, {3000, 3001}, disparity).code(),
            StatusCode::disparity_range_too_large);
  EXPECT_EQ(matcher.match({picture, picture}, {3, 2}, disparity).code(),
            StatusCode::disparity_range_too_large);
  const auto wide = random_texture(65, 32, 19);
  EXPECT_EQ(matcher.match({picture, wide}, {0, 19}, disparity).code(), StatusCode::out_of_memory);
  const auto high = random_texture(64, 33, 19);
  EXPECT_EQ(matcher.match({high, high}, {0, 19}, disparity).code(), StatusCode::out_of_memory);
}

TEST(Synthetic, RefusesParametersOutOfRange) {
  const auto refused = [](auto change) {
    StereoParams params;
    change(params);
    return !validate(params).ok();
  };
  EXPECT_FALSE(refused([](StereoParams&) {}));
  EXPECT_TRUE(refused([](StereoParams& p) { p.census_radius_px = 5; }));
  EXPECT_TRUE(refused([](StereoParams& p) { p.window_radius_px = 5; }));
  EXPECT_TRUE(refused([](StereoParams& p) { p.levels = 0; }));
  EXPECT_TRUE(refused([](StereoParams& p) { p.band_px = -1; }));
  EXPECT_TRUE(refused([](StereoParams& p) { p.smoothness = std::nan(""); }));
  EXPECT_TRUE(refused([](StereoParams& p) { p.smoothness_deviation = 0.0; }));
  EXPECT_TRUE(refused([](StereoParams& p) { p.median_radius_px = 4; }));
  EXPECT_TRUE(refused([](StereoParams& p) { p.variance_radius_px = 9; }));
}

// The largest rectified pictures that the design foresees.
TEST(Synthetic, TheWorkspaceKeepsToItsBudget) {
  ArenaPlan plan;
  StereoWorkspace workspace;
  workspace.allocate(plan, 700, 640, 192, StereoParams{});
  std::printf("%.2f MiB\n", static_cast<double>(plan.high_water_bytes()) / (1 << 20));
  EXPECT_LE(plan.high_water_bytes(), std::size_t{12} << 20);
}

}  // namespace
}  // namespace traygauge::paper
