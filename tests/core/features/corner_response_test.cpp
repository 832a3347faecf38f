// The corners' strength against OpenCV's smaller eigenvalue.
#include "core/features/corner_response.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <vector>

#include "tests/support/allocated.hpp"
#include "tests/support/pictures.hpp"

namespace traygauge {
namespace {

// OpenCV divides Sobel's gradients by 4 · 5 · 255 and adds over the window; ours are means of those divided
// by 8.
constexpr double kOurPerTheirs = (4.0 * 5.0 * 255.0) * (4.0 * 5.0 * 255.0) / (64.0 * 25.0);

TEST(CornerResponse, IsOpenCvsSmallerEigenvalue) {
  cv::RNG random(3);
  for (const cv::Size size : {cv::Size(7, 7), cv::Size(60, 40), cv::Size(300, 31), cv::Size(258, 9)}) {
    const cv::Mat picture = size.width > 100 ? test::textured_picture(size.width, size.height, 5)
                                             : test::random_picture(size.width, size.height, CV_8UC1, random);
    cv::Mat1f theirs;
    cv::cornerMinEigenVal(picture, theirs, 5, 3);
    test::Allocated<CornerResponseWorkspace> space(size.width);
    CornerResponse response(test::view_of(picture), *space);
    std::vector<float> row(static_cast<std::size_t>(size.width), -1.0F);
    for (int y = CornerResponse::first_row(); y < response.end_row(); ++y) {
      response.next_row(row);
      for (int x = 0; x < size.width; ++x) {
        const bool is_edge = x < kCornerBorder || x >= size.width - kCornerBorder;
        const double expected = is_edge ? 0.0 : kOurPerTheirs * static_cast<double>(theirs(y, x));
        ASSERT_NEAR(static_cast<double>(row[static_cast<std::size_t>(x)]), expected, 1e-3 * expected + 0.05)
            << size << ' ' << x << ' ' << y;
      }
    }
    EXPECT_EQ(response.end_row(), size.height - kCornerBorder);
  }
}

TEST(CornerResponse, AnEdgeHasNone) {
  cv::Mat1b picture(40, 40, std::uint8_t{20});
  picture.colRange(20, 40) = 220;
  test::Allocated<CornerResponseWorkspace> space(40);
  CornerResponse response(test::view_of(picture), *space);
  std::vector<float> row(40);
  for (int y = CornerResponse::first_row(); y < response.end_row(); ++y) {
    response.next_row(row);
    for (const float value : row) ASSERT_NEAR(value, 0.0F, 1e-3F);
  }
}

}  // namespace
}  // namespace traygauge
