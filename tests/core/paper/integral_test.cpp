#include "core/paper/image/integral.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <vector>

#include "tests/support/pictures.hpp"

namespace traygauge::paper {
namespace {

using test::random_picture;
using test::view_of;

TEST(Integral, EqualsOpenCv) {
  cv::RNG rng(1);
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(7, 3), cv::Size(401, 223)}) {
    const cv::Mat picture = random_picture(size.width, size.height, CV_8U, rng);
    cv::Mat sums(size.height + 1, size.width + 1, CV_32S);
    build_integral(view_of(picture), {reinterpret_cast<std::uint32_t*>(sums.data), sums.cols, sums.rows});
    cv::Mat expected;
    cv::integral(picture, expected, CV_32S);
    EXPECT_EQ(cv::countNonZero(sums != expected), 0);
  }
}

TEST(Integral, BoxSumsEqualDirectSums) {
  cv::RNG rng(2);
  const cv::Mat picture = random_picture(90, 70, CV_8U, rng);
  std::vector<std::uint32_t> storage(91 * 71);
  const ImageView<std::uint32_t> integral(storage.data(), 91, 71);
  build_integral(view_of(picture), integral);
  for (int i = 0; i < 500; ++i) {
    const int x = rng.uniform(0, 90);
    const int y = rng.uniform(0, 70);
    const cv::Rect box(x, y, rng.uniform(0, 91 - x), rng.uniform(0, 71 - y));
    const double expected = box.area() == 0 ? 0.0 : cv::sum(picture(box))[0];
    ASSERT_EQ(box_sum(integral, box.x, box.y, box.width, box.height), expected) << box;
  }
}

}  // namespace
}  // namespace traygauge::paper
