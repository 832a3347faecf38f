// The sensor does what its settings say, and JPEG files are what they should be.
#include "simulator/render/sensor.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <vector>

#include "simulator/capture/picture_file.hpp"
#include "simulator/capture/png_writer.hpp"
#include "simulator/render/jpeg_writer.hpp"

namespace traygauge {
namespace {

RenderedView even_view(int width, int height, const Eigen::Vector3f& radiance) {
  RenderedView view;
  view.width = width;
  view.height = height;
  view.radiance.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), radiance);
  return view;
}

SensorSettings without_noise() {
  SensorSettings settings;
  settings.full_well_electrons = 1e12;
  settings.read_noise_electrons = 0.0;
  settings.corner_loss = 0.0;
  return settings;
}

// IEC 61966-2-1 from the other side.
double linear_of(std::uint8_t value) {
  const double share = value / 255.0;
  return share <= 0.04045 ? share / 12.92 : std::pow((share + 0.055) / 1.055, 2.4);
}

struct Moments {
  double mean = 0.0;
  double variance = 0.0;
};

Moments linear_moments(const Picture& picture, std::size_t color) {
  Moments moments;
  const std::size_t count = picture.pixels.size() / 3;
  for (std::size_t i = 0; i < count; ++i)
    moments.mean += linear_of(picture.pixels[3 * i + color]) / static_cast<double>(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double off = linear_of(picture.pixels[3 * i + color]) - moments.mean;
    moments.variance += off * off / static_cast<double>(count - 1);
  }
  return moments;
}

// What rounding to 8 bits adds: the step of the linear value there, squared, over 12.
double rounding_variance(double linear) {
  const double step = linear_of(static_cast<std::uint8_t>(
                          std::lround(255.0 * (1.055 * std::pow(linear, 1.0 / 2.4) - 0.055)) + 1)) -
                      linear;
  return step * step / 12.0;
}

TEST(Sensor, NoiseIsThatOfElectronsAndAmplifier) {
  for (const double level : {0.05, 0.2, 0.5}) {
    SensorSettings settings;
    settings.corner_loss = 0.0;
    settings.full_well_electrons = 2000.0;
    settings.read_noise_electrons = 6.0;
    const Picture picture =
        develop(even_view(400, 300, Eigen::Vector3f::Constant(static_cast<float>(level))), settings, 5);
    const double variance = (2000.0 * level + 36.0) / (2000.0 * 2000.0);
    for (std::size_t color = 0; color < 3; ++color) {
      const Moments moments = linear_moments(picture, color);
      EXPECT_NEAR(moments.mean, level, 4.0 * std::sqrt(variance / 120000.0) + 0.001 * level);
      EXPECT_NEAR(moments.variance / (variance + rounding_variance(level)), 1.0, 0.03) << level;
    }
  }
}

TEST(Sensor, NoiseOfPixelsAndColorsIsIndependent) {
  const Picture picture =
      develop(even_view(300, 300, Eigen::Vector3f::Constant(0.3F)), {.corner_loss = 0.0}, 9);
  const double mean = [&] {
    double sum = 0.0;
    for (const std::uint8_t value : picture.pixels) sum += value;
    return sum / static_cast<double>(picture.pixels.size());
  }();
  const auto correlation = [&](std::size_t shift) {
    double product = 0.0;
    double square = 0.0;
    for (std::size_t i = 0; i + shift < picture.pixels.size(); ++i) {
      product += (picture.pixels[i] - mean) * (picture.pixels[i + shift] - mean);
      square += (picture.pixels[i] - mean) * (picture.pixels[i] - mean);
    }
    return product / square;
  };
  for (const std::size_t shift : {1U, 2U, 3U, 900U}) EXPECT_NEAR(correlation(shift), 0.0, 0.01) << shift;
}

TEST(Sensor, ExposureAndWhiteBalanceAreGains) {
  SensorSettings settings = without_noise();
  settings.exposure = 0.5;
  settings.white_balance = {1.6, 1.0, 1.25};
  const Picture picture = develop(even_view(20, 20, {0.5F, 0.8F, 0.4F}), settings, 1);
  const std::array<double, 3> expected = {0.4, 0.4, 0.25};
  for (std::size_t color = 0; color < 3; ++color)
    EXPECT_NEAR(linear_of(picture.pixels[color]), expected[color], 0.004);
  EXPECT_EQ(picture.pixels[0], 170);  // 0.4 by the standard's formula
}

TEST(Sensor, IsCutOffWhereTheWellIsFull) {
  SensorSettings settings = without_noise();
  settings.white_balance = {0.5, 1.0, 2.0};
  const Picture picture = develop(even_view(20, 20, Eigen::Vector3f::Constant(7.0F)), settings, 1);
  EXPECT_NEAR(linear_of(picture.pixels[0]), 0.5, 0.004);
  EXPECT_EQ(picture.pixels[1], 255);
  EXPECT_EQ(picture.pixels[2], 255);
}

TEST(Sensor, CornersLoseTheirShareByTheCosineLaw) {
  SensorSettings settings = without_noise();
  settings.corner_loss = 0.4;
  const Picture picture = develop(even_view(161, 121, Eigen::Vector3f::Constant(0.8F)), settings, 1);
  const auto at = [&](std::size_t x, std::size_t y) { return linear_of(picture.pixels[3 * (161 * y + x)]); };
  EXPECT_NEAR(at(80, 60), 0.8, 0.005);
  for (const auto& [x, y] : {std::pair{0, 0}, {160, 0}, {0, 120}, {160, 120}}) {
    EXPECT_NEAR(at(static_cast<std::size_t>(x), static_cast<std::size_t>(y)), 0.48, 0.004);
  }
  // tan² of the angle is a share of the corner's: 0.64 at the middle of the right side.
  const double corner_tan2 = 1.0 / std::sqrt(0.6) - 1.0;
  EXPECT_NEAR(at(160, 60), 0.8 * std::pow(std::cos(std::atan(std::sqrt(0.64 * corner_tan2))), 4.0), 0.005);
}

TEST(Sensor, SeedDecidesTheNoise) {
  const RenderedView view = even_view(64, 48, Eigen::Vector3f::Constant(0.4F));
  EXPECT_EQ(develop(view, {}, 3).pixels, develop(view, {}, 3).pixels);
  EXPECT_NE(develop(view, {}, 3).pixels, develop(view, {}, 4).pixels);
}

TEST(Sensor, AnyNumberOfThreadsGivesTheSamePicture) {
  const RenderedView view = even_view(64, 48, Eigen::Vector3f::Constant(0.4F));
  EXPECT_EQ(develop(view, {}, 3, 3).pixels, develop(view, {}, 3, 1).pixels);
  EXPECT_EQ(develop(view, {}, 3).pixels, develop(view, {}, 3, 1).pixels);
}

TEST(Sensor, RefusesSettingsThatMakeNoSense) {
  const RenderedView view = even_view(16, 16, Eigen::Vector3f::Ones());
  EXPECT_THROW(develop(view, {.exposure = 0.0}, 1), std::invalid_argument);
  EXPECT_THROW(develop(view, {.white_balance = {1.0, -1.0, 1.0}}, 1), std::invalid_argument);
  EXPECT_THROW(develop(view, {.corner_loss = 1.0}, 1), std::invalid_argument);
  EXPECT_THROW(develop(view, {.full_well_electrons = 0.0}, 1), std::invalid_argument);
  EXPECT_THROW(develop(view, {.read_noise_electrons = std::nan("")}, 1), std::invalid_argument);
}

class JpegWriter : public ::testing::Test {
 protected:
  JpegWriter()
      : file_(std::filesystem::temp_directory_path() / ("traygauge_" + std::to_string(::getpid()) + ".jpg")) {
  }
  ~JpegWriter() override { std::filesystem::remove(file_); }

  static Picture gradient() {
    Picture picture({160, 120}, PixelFormat::rgb8);
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
      picture.pixels[i] = static_cast<std::uint8_t>(40 + i / 3 % 160 + (i % 3 == 0 ? 40 : 0));
    }
    return picture;
  }

  std::filesystem::path file_;
};

TEST_F(JpegWriter, PicturesComeBack) {
  const Picture picture = gradient();
  write_jpeg(file_, picture, 95);
  const Picture again = read_picture({file_, ""});
  ASSERT_EQ(again.size, picture.size);
  double square = 0.0;
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    const double off = static_cast<double>(again.pixels[i]) - picture.pixels[i];
    square += off * off / static_cast<double>(picture.pixels.size());
  }
  EXPECT_LT(std::sqrt(square), 1.5);
}

TEST_F(JpegWriter, QualityAndColorsAreThoseOfCameras) {
  write_jpeg(file_, gradient(), 95);
  const auto fine = std::filesystem::file_size(file_);
  write_jpeg(file_, gradient(), 40);
  EXPECT_LT(std::filesystem::file_size(file_), fine);
  std::ifstream stream(file_, std::ios::binary);
  const std::vector<unsigned char> bytes((std::istreambuf_iterator<char>(stream)), {});
  // Frame header, ITU T.81 B.2.2: FF C0, length, depth, height, width, 3 colours of (number, factors, table).
  const std::array<unsigned char, 2> marker = {0xFF, 0xC0};
  const auto at = std::search(bytes.begin(), bytes.end(), marker.begin(), marker.end());
  ASSERT_GT(bytes.end() - at, 19);
  EXPECT_EQ(at[11], 0x22);
  EXPECT_EQ(at[14], 0x11);
  EXPECT_EQ(at[17], 0x11);
}

TEST_F(JpegWriter, SaysWhatCannotBeWritten) {
  EXPECT_THROW(write_jpeg("/nowhere/picture.jpg", gradient(), 90), OutputError);
  EXPECT_THROW(write_jpeg(file_, gradient(), 0), std::invalid_argument);
  EXPECT_THROW(write_jpeg(file_, Picture({16, 16}, PixelFormat::gray8), 90), std::invalid_argument);
  EXPECT_FALSE(std::filesystem::exists(file_));
}

TEST_F(JpegWriter, LeavesNoHalfWrittenPicture) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  EXPECT_THROW(write_jpeg("/dev/full", gradient(), 90), OutputError);
}

}  // namespace
}  // namespace traygauge
