#include "firmware/handover/tray_picture.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <opencv2/imgcodecs.hpp>
#include <vector>

namespace traygauge::test {
namespace {

// Red grows to the right and green downwards; blue is a half. Read by OpenCV, whose decoder we did not write.
class TrayPicture : public ::testing::TestWithParam<PixelFormat> {
 protected:
  static std::vector<std::uint8_t> pixels(int width, int height, std::ptrdiff_t stride) {
    std::vector<std::uint8_t> all(static_cast<std::size_t>(stride * height), 7);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const int red = 255 * x / width;
        const int green = 255 * y / height;
        const int channels = bytes_per_pixel(GetParam());
        std::uint8_t* const pixel = all.data() + y * stride + static_cast<std::ptrdiff_t>(x) * channels;
        pixel[0] = static_cast<std::uint8_t>(GetParam() == PixelFormat::bgr8 ? 128 : red);
        if (channels == 1) continue;
        pixel[1] = static_cast<std::uint8_t>(green);
        pixel[2] = static_cast<std::uint8_t>(GetParam() == PixelFormat::bgr8 ? red : 128);
      }
    }
    return all;
  }
  static cv::Mat composed(int width, int height) {
    const std::ptrdiff_t stride = static_cast<std::ptrdiff_t>(width) * bytes_per_pixel(GetParam()) + 5;
    const std::vector<std::uint8_t> all = pixels(width, height, stride);
    const std::string jpeg = compose_picture({all.data(), width, height, stride, GetParam()});
    return cv::imdecode(std::vector<std::uint8_t>(jpeg.begin(), jpeg.end()), cv::IMREAD_UNCHANGED);
  }
};

TEST_P(TrayPicture, IsSmallAndHasTheFramesColours) {
  for (const auto [width, height, factor] :
       {std::array{1600, 1200, 2}, std::array{640, 480, 1}, std::array{801, 31, 2}}) {
    const cv::Mat picture = composed(width, height);
    ASSERT_EQ(picture.cols, width / factor);
    ASSERT_EQ(picture.rows, height / factor);
    ASSERT_EQ(picture.channels(), bytes_per_pixel(GetParam()));
    for (const auto [u, v] : {std::array{0.25, 0.25}, std::array{0.75, 0.25}, std::array{0.5, 0.75}}) {
      const int x = static_cast<int>(u * picture.cols);
      const int y = static_cast<int>(v * picture.rows);
      constexpr double kJpegLoss = 6.0;
      if (picture.channels() == 1) {
        EXPECT_NEAR(picture.at<std::uint8_t>(y, x), 255.0 * u, kJpegLoss);
        continue;
      }
      const cv::Vec3b colour = picture.at<cv::Vec3b>(y, x);
      EXPECT_NEAR(colour[0], 128.0, kJpegLoss);
      EXPECT_NEAR(colour[1], 255.0 * v, kJpegLoss + 255.0 / picture.rows);
      EXPECT_NEAR(colour[2], 255.0 * u, kJpegLoss);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, TrayPicture,
                         ::testing::Values(PixelFormat::gray8, PixelFormat::bgr8, PixelFormat::rgb8));

TEST(TrayPictureOfNothing, IsEmpty) {
  EXPECT_EQ(compose_picture({}), "");
}

}  // namespace
}  // namespace traygauge::test
