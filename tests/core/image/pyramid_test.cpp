#include "core/image/pyramid.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "tests/support/pictures.hpp"

namespace traygauge {
namespace {

using test::random_picture;
using test::view_of;

// Every size is made even by OpenCV's border replication, then compared pixel by pixel.
TEST(Halve, IsTheRoundedMeanOfFourWithTheBorderRepeated) {
  cv::RNG rng(1);
  for (const cv::Size size :
       {cv::Size(1, 1), cv::Size(2, 1), cv::Size(5, 4), cv::Size(64, 33), cv::Size(127, 91)}) {
    const cv::Mat source = random_picture(size.width, size.height, CV_8U, rng);
    cv::Mat target(halved(size.height), halved(size.width), CV_8U);
    halve(view_of(source), view_of(target));
    cv::Mat even;
    cv::copyMakeBorder(source, even, 0, size.height % 2, 0, size.width % 2, cv::BORDER_REPLICATE);
    for (int y = 0; y < target.rows; ++y) {
      for (int x = 0; x < target.cols; ++x) {
        const double sum = cv::sum(even(cv::Rect(2 * x, 2 * y, 2, 2)))[0];
        ASSERT_EQ(target.at<std::uint8_t>(y, x), static_cast<int>(sum + 2.0) / 4) << size;
      }
    }
  }
}

TEST(HalveMask, KeepsWhatCoversHalfAPixel) {
  cv::RNG rng(2);
  cv::Mat source = random_picture(91, 54, CV_8U, rng);
  cv::threshold(source, source, 128, 255, cv::THRESH_BINARY);
  cv::Mat target(halved(source.rows), halved(source.cols), CV_8U);
  halve_mask(view_of(source), view_of(target));
  cv::Mat even;
  cv::copyMakeBorder(source, even, 0, source.rows % 2, 0, source.cols % 2, cv::BORDER_REPLICATE);
  for (int y = 0; y < target.rows; ++y) {
    for (int x = 0; x < target.cols; ++x) {
      const int set = cv::countNonZero(even(cv::Rect(2 * x, 2 * y, 2, 2)));
      ASSERT_EQ(target.at<std::uint8_t>(y, x), set >= 2 ? 255 : 0);
    }
  }
}

}  // namespace
}  // namespace traygauge
