#include "core/quality/picture_colour.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

namespace traygauge {
namespace {

constexpr int kPaintedColumns = 200;
constexpr int kPaintedRows = 100;

// `coloured_rows` at the top, the rest grey; rows end with a byte of padding.
bool shows(PixelFormat format, int coloured_rows, const std::array<std::uint8_t, 3>& colour) {
  const int stride = kPaintedColumns * bytes_per_pixel(format) + 1;
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(stride) * kPaintedRows, 120);
  for (int y = 0; y < coloured_rows; ++y) {
    for (int x = 0; x < kPaintedColumns * bytes_per_pixel(format); ++x)
      bytes[static_cast<std::size_t>(y * stride + x)] = colour[static_cast<std::size_t>(x % 3)];
  }
  return shows_colour({bytes.data(), kPaintedColumns, kPaintedRows, stride, format}, {});
}

constexpr std::array<std::uint8_t, 3> kPaint{30, 40, 200};

TEST(PictureColour, AGreyPictureShowsNone) {
  EXPECT_FALSE(shows(PixelFormat::bgr8, 0, kPaint));
  EXPECT_FALSE(shows(PixelFormat::gray8, kPaintedRows, kPaint));
  EXPECT_FALSE(shows_colour({}, {}));
}

TEST(PictureColour, AFewColouredPixelsAreADeadRowOrAnEdge) {
  EXPECT_FALSE(shows(PixelFormat::rgb8, 4, kPaint));
  EXPECT_TRUE(shows(PixelFormat::rgb8, 8, kPaint));
  EXPECT_TRUE(shows(PixelFormat::bgr8, 8, kPaint));
}

TEST(PictureColour, NoiseAndATingeOfTheLightAreNoColour) {
  EXPECT_FALSE(shows(PixelFormat::bgr8, kPaintedRows, {110, 114, 118}));
  EXPECT_TRUE(shows(PixelFormat::bgr8, kPaintedRows, {110, 114, 119}));
}

}  // namespace
}  // namespace traygauge
