#include "core/quality/exposure.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "tests/support/pictures.hpp"

namespace traygauge {
namespace {

using test::random_picture;
using test::view_of;

// A picture of `share` pixels of `value`, the others random in 60 … 200.
cv::Mat picture_with(double share, int value) {
  cv::RNG rng(4);
  cv::Mat picture(101, 203, CV_8U);
  rng.fill(picture, cv::RNG::UNIFORM, 60, 200);
  const int count = static_cast<int>(share * static_cast<double>(picture.total()));
  for (int i = 0; i < count; ++i) picture.data[i] = static_cast<std::uint8_t>(value);
  return picture;
}

StatusCode check(const cv::Mat& picture) {
  return check_exposure(view_of(picture), ExposureParams{}).code();
}

TEST(Exposure, SharesDecide) {
  EXPECT_EQ(check(picture_with(0.94, 8)), StatusCode::ok);
  EXPECT_EQ(check(picture_with(0.96, 8)), StatusCode::frame_too_dark);
  EXPECT_EQ(check(picture_with(0.96, 9)), StatusCode::ok);
  EXPECT_EQ(check(picture_with(0.59, 252)), StatusCode::ok);
  EXPECT_EQ(check(picture_with(0.61, 252)), StatusCode::frame_too_bright);
  EXPECT_EQ(check(picture_with(0.61, 251)), StatusCode::ok);
}

TEST(Exposure, UniformGrayHasNoFeatures) {
  cv::RNG rng(6);
  cv::Mat picture(120, 160, CV_8U);
  rng.fill(picture, cv::RNG::NORMAL, 120, 2.0);
  EXPECT_EQ(check(picture), StatusCode::too_few_features);
  rng.fill(picture, cv::RNG::NORMAL, 120, 4.0);
  EXPECT_EQ(check(picture), StatusCode::ok);
  EXPECT_EQ(check_exposure({}, ExposureParams{}).code(), StatusCode::frame_missing);
}

TEST(Exposure, PhotographsOfMealsPass) {
  const char* captures = std::getenv("TRAYGAUGE_CAPTURES");
  if (captures == nullptr) GTEST_SKIP() << "TRAYGAUGE_CAPTURES is not set";
  for (const char* path : {"/meals/m01/view_0.jpg", "/trays/t04/view_1.jpg", "/plates/c1_soup/view_0.jpg"}) {
    const cv::Mat picture = cv::imread(std::string(captures) + path, cv::IMREAD_GRAYSCALE);
    ASSERT_FALSE(picture.empty()) << path;
    EXPECT_EQ(check(picture), StatusCode::ok) << path;
    cv::Mat dark = picture / 40;
    EXPECT_EQ(check(dark), StatusCode::frame_too_dark) << path;
    cv::Mat bright = picture * 6;
    EXPECT_EQ(check(bright), StatusCode::frame_too_bright) << path;
  }
}

}  // namespace
}  // namespace traygauge
