#include "firmware/segment/food_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

namespace traygauge {
namespace {

TEST(FoodMap, ShowsEachPlaceInItsView) {
  constexpr PictureSize kSize{12, 8};
  FoodMap food;
  food.on_view(0);
  food.on_place({1.5, 3.5}, 4, {}, 0.0);     // columns 0 to 3, rows 2 to 5
  food.on_place({10.5, 6.5}, 4, {}, 100.0);  // in part beyond the picture
  food.on_view(1);
  food.on_place({5.5, 5.5}, 2, {}, -100.0);
  const cv::Mat first = food.probabilities(0, kSize);
  const cv::Mat second = food.probabilities(1, kSize);
  ASSERT_EQ(first.size(), cv::Size(12, 8));
  int known = 0;
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 12; ++x) {
      const float value = first.at<float>(y, x);
      if (std::isnan(value)) continue;
      ++known;
      EXPECT_FLOAT_EQ(value, x < 4 ? 0.5F : 1.0F) << x << ' ' << y;
    }
  }
  EXPECT_EQ(known, 4 * 4 + 3 * 3);
  EXPECT_FLOAT_EQ(first.at<float>(2, 0), 0.5F);
  EXPECT_FLOAT_EQ(first.at<float>(7, 11), 1.0F);
  EXPECT_NEAR(second.at<float>(5, 5), 0.0F, 1e-6F);
  EXPECT_TRUE(std::isnan(second.at<float>(3, 1)));
}

}  // namespace
}  // namespace traygauge
