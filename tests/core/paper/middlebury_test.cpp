// Real photographs with structured-light truth (Scharstein & Szeliski 2003), OpenCV's matcher beside ours.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "tests/core/paper/stereo_scene.hpp"

namespace traygauge::paper {
namespace {

using test::match;
using test::TestPair;

constexpr int kMaxDisparity = 63;  // left → right these are negative

struct RealPair {
  TestPair pair;
  cv::Mat_<float> truth;  // of the first picture, our sign; NaN where unknown
  cv::Mat_<std::uint8_t> unoccluded;
};

cv::Mat_<float> read_truth(const std::filesystem::path& file) {
  cv::Mat_<float> truth;
  cv::imread(file.string(), cv::IMREAD_GRAYSCALE).convertTo(truth, CV_32F, 0.25);
  return truth;
}

RealPair read_pair(const std::filesystem::path& folder, const std::string& name) {
  RealPair real;
  const auto gray = [&](const char* suffix) -> cv::Mat_<std::uint8_t> {
    return cv::imread((folder / (name + suffix)).string(), cv::IMREAD_GRAYSCALE);
  };
  real.pair = TestPair(gray("-im2.png"), gray("-im6.png"));
  const auto left = read_truth(folder / (name + "-disp2.pgm"));
  const auto right = read_truth(folder / (name + "-disp6.pgm"));
  real.truth.create(left.size());
  real.unoccluded = cv::Mat_<std::uint8_t>::zeros(left.size());
  for (int y = 0; y < left.rows; ++y) {
    for (int x = 0; x < left.cols; ++x) {
      const float d = left(y, x);
      real.truth(y, x) = d > 0.0F ? -d : std::nanf("");
      const int partner = x - static_cast<int>(std::lround(d));
      real.unoccluded(y, x) = d > 0.0F && partner >= 0 && std::abs(right(y, partner) - d) <= 1.0F;
    }
  }
  return real;
}

// Share of the unoccluded pixels that are off by more than a pixel, or unknown.
double bad_pixels(const RealPair& real, const cv::Mat_<Disparity>& disparity) {
  int bad = 0;
  int all = 0;
  for (int y = 0; y < disparity.rows; ++y) {
    for (int x = 0; x < disparity.cols; ++x) {
      if (real.unoccluded(y, x) == 0) continue;
      ++all;
      const float error = static_cast<float>(disparity(y, x)) / kDisparityScale - real.truth(y, x);
      bad += disparity(y, x) == kNoDisparity || std::abs(error) > 1.0F;
    }
  }
  return static_cast<double>(bad) / all;
}

double opencv_bad_pixels(const RealPair& real) {
  constexpr int kBlock = 5;
  constexpr int kArea = kBlock * kBlock;
  const auto matcher = cv::StereoSGBM::create(0, kMaxDisparity + 1, kBlock, 8 * kArea, 32 * kArea);
  matcher->setMode(cv::StereoSGBM::MODE_HH);
  cv::Mat_<Disparity> disparity;
  matcher->compute(real.pair.first, real.pair.second, disparity);
  for (Disparity& d : disparity) d = d < 0 ? kNoDisparity : static_cast<Disparity>(-d);
  return bad_pixels(real, disparity);
}

TEST(Middlebury, FewPixelsAreBad) {
  const char* captures = std::getenv("TRAYGAUGE_CAPTURES");
  if (captures == nullptr) GTEST_SKIP() << "TRAYGAUGE_CAPTURES is not set";
  const auto folder = std::filesystem::path(captures) / "real" / "stereo_middlebury2003";
  for (const std::string name : {"cones", "teddy"}) {
    const RealPair real = read_pair(folder, name);
    ASSERT_FALSE(real.pair.first.empty());
    double share[3];
    for (const MatchingCost cost : {MatchingCost::census, MatchingCost::sad, MatchingCost::zncc}) {
      StereoParams params;
      params.cost = cost;
      share[static_cast<int>(cost)] = bad_pixels(real, match(real.pair, {-kMaxDisparity, 0}, params));
    }
    std::printf("%s: bad pixels census %.1f %%, SAD %.1f %%, ZNCC %.1f %%; OpenCV's SGBM %.1f %%\n",
                name.c_str(), 100.0 * share[0], 100.0 * share[1], 100.0 * share[2],
                100.0 * opencv_bad_pixels(real));
    EXPECT_LT(share[0], 0.10);
    EXPECT_LT(share[1], 0.20);
    EXPECT_LT(share[2], 0.15);
    EXPECT_LT(share[0], share[1]);  // the paper's order of the costs
    EXPECT_LT(share[0], share[2]);
  }
}

}  // namespace
}  // namespace traygauge::paper
