#include "core/stereo/median.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/support/pictures.hpp"

namespace traygauge {
namespace {

using test::view_of;

Disparity sorted_median(const cv::Mat_<Disparity>& picture, int x, int y, int radius) {
  if (picture(y, x) == kNoDisparity) return kNoDisparity;
  std::vector<Disparity> known;
  for (int v = std::max(y - radius, 0); v <= std::min(y + radius, picture.rows - 1); ++v) {
    for (int u = std::max(x - radius, 0); u <= std::min(x + radius, picture.cols - 1); ++u) {
      if (picture(v, u) != kNoDisparity) known.push_back(picture(v, u));
    }
  }
  std::sort(known.begin(), known.end());
  return known[known.size() / 2];
}

TEST(Median, EqualsSortingOfTheKnownNeighbours) {
  const std::uint64_t seed = 20260131;
  std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
  cv::RNG rng(seed);
  for (int trial = 0; trial < 40; ++trial) {
    cv::Mat_<Disparity> picture(rng.uniform(1, 30), rng.uniform(1, 40));
    const int unknown_percent = rng.uniform(0, 4) * 30;
    for (Disparity& disparity : picture) {
      disparity = rng.uniform(0, 100) < unknown_percent ? kNoDisparity
                                                        : static_cast<Disparity>(rng.uniform(-32767, 32768));
    }
    for (int radius = 0; radius <= kMaxMedianRadius; ++radius) {
      cv::Mat_<Disparity> filtered(picture.size());
      filter_median(view_of(std::as_const(picture)), radius, view_of(filtered));
      for (int y = 0; y < picture.rows; ++y) {
        for (int x = 0; x < picture.cols; ++x) {
          ASSERT_EQ(filtered(y, x), sorted_median(picture, x, y, radius))
              << "trial " << trial << " radius " << radius << " at " << x << ", " << y;
        }
      }
    }
  }
}

}  // namespace
}  // namespace traygauge
