// Every conversion against OpenCV's, on random bytes: random sizes, rows with padding, all Bayer patterns.
#include <gtest/gtest.h>

#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <random>

#include "drivers/pixels/frame_converter.hpp"

namespace traygauge {
namespace {

constexpr int kRuns = 60;

class Converters : public testing::Test {
 protected:
  std::vector<std::uint8_t> draw_bytes(std::size_t count) {
    std::vector<std::uint8_t> bytes(count);
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random_());
    return bytes;
  }
  int draw(int min, int max) { return std::uniform_int_distribution<int>(min, max)(random_); }

  cv::Mat convert(const RawFormat& format, int width, int height, std::ptrdiff_t stride,
                  const std::vector<std::uint8_t>& bytes) {
    FrameConverter converter(format, width, height, stride);
    EXPECT_TRUE(converter.is_whole(bytes));
    cv::Mat picture(height, width, converter.pixels() == PixelFormat::gray8 ? CV_8UC1 : CV_8UC3);
    EXPECT_TRUE(converter.convert(bytes, picture.data));
    return picture;
  }

  std::mt19937 random_{20261122};
};

void expect_equal(const cv::Mat& ours, const cv::Mat& theirs, const std::string& what) {
  ASSERT_EQ(ours.size(), theirs.size()) << what;
  EXPECT_EQ(cv::norm(ours, theirs, cv::NORM_INF), 0.0) << what;
}

TEST_F(Converters, YuyvIsWhatOpenCvMakesOfIt) {
  for (int run = 0; run < kRuns; ++run) {
    const int width = 2 * draw(1, 150);
    const int height = draw(1, 40);
    const int stride = 2 * width + 2 * draw(0, 8);
    auto bytes = draw_bytes(static_cast<std::size_t>(stride * height));
    const cv::Mat raw(height, width, CV_8UC2, bytes.data(), static_cast<std::size_t>(stride));
    cv::Mat theirs;
    cv::cvtColor(raw, theirs, cv::COLOR_YUV2BGR_YUY2);
    expect_equal(convert({RawEncoding::yuyv}, width, height, stride, bytes), theirs,
                 "run " + std::to_string(run));
  }
}

TEST_F(Converters, Nv12IsWhatOpenCvMakesOfIt) {
  for (int run = 0; run < kRuns; ++run) {
    const int width = 2 * draw(1, 150);
    const int height = 2 * draw(1, 30);
    const int stride = width + draw(0, 8);
    auto bytes = draw_bytes(static_cast<std::size_t>(stride * height * 3 / 2));
    const auto step = static_cast<std::size_t>(stride);
    const cv::Mat grey(height, width, CV_8UC1, bytes.data(), step);
    const cv::Mat colour(height / 2, width / 2, CV_8UC2,
                         bytes.data() + step * static_cast<std::size_t>(height), step);
    cv::Mat theirs;
    cv::cvtColorTwoPlane(grey, colour, theirs, cv::COLOR_YUV2BGR_NV12);
    expect_equal(convert({RawEncoding::nv12}, width, height, stride, bytes), theirs,
                 "run " + std::to_string(run));
  }
}

TEST_F(Converters, EveryByteOfGreyAndColourIsConvertedAsByOpenCv) {
  // Every third grey value with all u and v; the pair's right pixel has the grey values from the other end.
  std::vector<std::uint8_t> bytes(std::size_t{512} * 256 * 2);
  const cv::Mat raw(256, 512, CV_8UC2, bytes.data());
  for (int grey = 0; grey < 256; grey += 3) {
    for (std::size_t i = 0; i < bytes.size(); i += 4) {
      bytes[i] = static_cast<std::uint8_t>(grey);
      bytes[i + 1] = static_cast<std::uint8_t>(i / 4);
      bytes[i + 2] = static_cast<std::uint8_t>(255 - grey);
      bytes[i + 3] = static_cast<std::uint8_t>(i / 1024);
    }
    cv::Mat theirs;
    cv::cvtColor(raw, theirs, cv::COLOR_YUV2BGR_YUY2);
    expect_equal(convert({RawEncoding::yuyv}, 512, 256, 1024, bytes), theirs, "grey " + std::to_string(grey));
  }
}

// OpenCV knows BT.601 in full range, by coefficients of three digits.
TEST_F(Converters, FullRangeUsesAllOfGrey) {
  const YuvCoding full{true, false};
  cv::Mat ours(256, 256, CV_8UC3);
  cv::Mat yuv(256, 256, CV_8UC3);
  for (int grey = 0; grey < 256; grey += 5) {
    std::vector<std::uint8_t> bytes(std::size_t{2} * 256 * 256);
    for (std::size_t i = 0; i < bytes.size(); i += 4) {
      const std::uint8_t u = static_cast<std::uint8_t>(i / 512);
      const std::uint8_t v = static_cast<std::uint8_t>(i % 512 / 2);
      bytes[i] = bytes[i + 2] = static_cast<std::uint8_t>(grey);
      bytes[i + 1] = u;
      bytes[i + 3] = v;
      for (std::size_t k = 0; k < 2; ++k) {
        std::uint8_t* const pixel = yuv.data + 3 * (i / 2 + k);
        pixel[0] = static_cast<std::uint8_t>(grey), pixel[1] = v, pixel[2] = u;
      }
    }
    cv::Mat theirs;
    cv::cvtColor(yuv, theirs, cv::COLOR_YCrCb2BGR);
    ASSERT_TRUE(FrameConverter({RawEncoding::yuyv}, 256, 256, 512, full).convert(bytes, ours.data));
    EXPECT_LE(cv::norm(ours, theirs, cv::NORM_INF), 1.0) << grey;
  }
}

int opencv_code(BayerPattern pattern) {
  switch (pattern) {  // OpenCV names the second row's second and third pixel
    case BayerPattern::rggb:
      return cv::COLOR_BayerBG2BGR;
    case BayerPattern::grbg:
      return cv::COLOR_BayerGB2BGR;
    case BayerPattern::gbrg:
      return cv::COLOR_BayerGR2BGR;
    case BayerPattern::bggr:
      return cv::COLOR_BayerRG2BGR;
  }
  return -1;
}

// Samples as a sensor stores them.
std::vector<std::uint8_t> store(const RawFormat& format, const cv::Mat_<std::uint16_t>& samples,
                                std::ptrdiff_t stride) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(stride * samples.rows));
  for (int y = 0; y < samples.rows; ++y) {
    std::uint8_t* to = bytes.data() + y * stride;
    for (int x = 0; x < samples.cols; ++x) {
      const int sample = samples(y, x);
      if (format.is_packed) {
        const int group = format.bits == 10 ? 4 : 2;
        const int low_bits = format.bits - 8;
        const int low = sample & ((1 << low_bits) - 1);
        std::uint8_t* const packed = to + x / group * (group + 1);
        packed[x % group] = static_cast<std::uint8_t>(sample >> low_bits);
        packed[group] = static_cast<std::uint8_t>(packed[group] | low << (x % group * low_bits));
      } else if (format.bits == 8) {
        to[x] = static_cast<std::uint8_t>(sample);
      } else {
        to[2 * x] = static_cast<std::uint8_t>(sample);
        to[2 * x + 1] = static_cast<std::uint8_t>(sample >> 8);
      }
    }
  }
  return bytes;
}

TEST_F(Converters, EveryBayerPatternAndDepthIsWhatOpenCvMakesOfIt) {
  for (int run = 0; run < 4 * kRuns; ++run) {
    RawFormat format{RawEncoding::bayer};
    format.pattern = static_cast<BayerPattern>(run % 4);
    format.bits = draw(8, 12);
    format.is_packed = format.bits % 2 == 0 && format.bits > 8 && draw(0, 1) == 1;
    const int width = 4 * draw(1, 40);
    const int height = 2 * draw(2, 20);
    const auto stride = static_cast<std::ptrdiff_t>(row_bytes(format, width)) + draw(0, 8);
    cv::Mat_<std::uint16_t> samples(height, width);
    for (auto& sample : samples) sample = static_cast<std::uint16_t>(draw(0, (1 << format.bits) - 1));
    cv::Mat upper;
    cv::Mat_<std::uint16_t> shifted = samples.clone();
    for (auto& sample : shifted) sample = static_cast<std::uint16_t>(sample >> (format.bits - 8));
    shifted.convertTo(upper, CV_8U);
    cv::Mat theirs;
    cv::cvtColor(upper, theirs, opencv_code(format.pattern));
    expect_equal(convert(format, width, height, stride, store(format, samples, stride)), theirs,
                 name(format) + " run " + std::to_string(run));
  }
}

TEST_F(Converters, GreyRgbAndBgrAreCopiedRowByRow) {
  for (const RawEncoding encoding : {RawEncoding::grey, RawEncoding::rgb24, RawEncoding::bgr24}) {
    const RawFormat format{encoding};
    const int channels = encoding == RawEncoding::grey ? 1 : 3;
    auto bytes = draw_bytes(std::size_t{70} * 20);
    const cv::Mat raw(20, 21, CV_8UC(channels), bytes.data(), 70);
    expect_equal(convert(format, 21, 20, 70, bytes), raw, name(format));
  }
  EXPECT_EQ(converted_pixels({RawEncoding::rgb24}), PixelFormat::rgb8);
  EXPECT_EQ(converted_pixels({RawEncoding::bgr24}), PixelFormat::bgr8);
}

// All but JPEG.
std::vector<RawFormat> formats_of_fixed_size() {
  std::vector<RawFormat> formats;
  for (int i = 0; i < kRawEncodingCount; ++i) {
    const RawFormat format{static_cast<RawEncoding>(i)};
    if (format.encoding != RawEncoding::mjpeg) formats.push_back(format);
  }
  return formats;
}

TEST_F(Converters, NothingIsWrittenBehindThePicture) {
  for (int run = 0; run < kRuns; ++run) {
    RawFormat format{static_cast<RawEncoding>(run % kRawEncodingCount)};
    if (format.encoding == RawEncoding::mjpeg) continue;
    const int width = 4 * draw(1, 70);
    const int height = 2 * draw(2, 9);
    const auto stride = static_cast<std::ptrdiff_t>(row_bytes(format, width));
    const auto bytes = draw_bytes(frame_bytes(format, width, height, stride));
    FrameConverter converter(format, width, height, stride);
    const std::size_t own = static_cast<std::size_t>(width * height * bytes_per_pixel(converter.pixels()));
    std::vector<std::uint8_t> out(own + 32, 0xA5);
    ASSERT_TRUE(converter.convert(bytes, out.data()));
    for (std::size_t i = own; i < out.size(); ++i) ASSERT_EQ(out[i], 0xA5) << name(format) << " run " << run;
  }
}

TEST_F(Converters, AMissingByteMakesThePictureIncomplete) {
  for (const RawFormat& format : formats_of_fixed_size()) {
    const auto stride = static_cast<std::ptrdiff_t>(row_bytes(format, 16));
    auto bytes = draw_bytes(frame_bytes(format, 16, 8, stride));
    FrameConverter converter(format, 16, 8, stride);
    EXPECT_TRUE(converter.is_whole(bytes)) << name(format);
    bytes.pop_back();
    EXPECT_FALSE(converter.is_whole(bytes)) << name(format);
    EXPECT_FALSE(converter.problem().empty());
  }
}

TEST_F(Converters, OddSizesAreRefusedWhereColoursAreShared) {
  EXPECT_FALSE(is_size_supported({RawEncoding::yuyv}, 15, 8));
  EXPECT_TRUE(is_size_supported({RawEncoding::yuyv}, 16, 7));
  EXPECT_FALSE(is_size_supported({RawEncoding::nv12}, 16, 7));
  EXPECT_FALSE(is_size_supported({RawEncoding::bayer}, 2, 8));
  EXPECT_FALSE(is_size_supported({RawEncoding::bayer, BayerPattern::rggb, 10, true}, 18, 8));
  EXPECT_TRUE(is_size_supported({RawEncoding::mjpeg}, 15, 7));
  EXPECT_FALSE(is_size_supported({RawEncoding::grey}, 0, 7));
}

TEST_F(Converters, ABlurredPictureIsLessSharp) {
  cv::Mat sharp(120, 160, CV_8UC1);
  cv::randu(sharp, 0, 256);
  cv::Mat blurred;
  cv::GaussianBlur(sharp, blurred, {5, 5}, 1.0);
  const auto grade = [](const RawFormat& format, const cv::Mat& grey) {
    std::vector<std::uint8_t> bytes;
    for (int i = 0; i < grey.rows * grey.cols; ++i) {
      const std::size_t copies = row_bytes(format, 1) > 0 ? row_bytes(format, 4) / 4 : 1;
      for (std::size_t k = 0; k < copies; ++k) bytes.push_back(grey.data[i]);
    }
    bytes.resize(bytes.size() * 3 / 2, 128);
    const auto stride = static_cast<std::ptrdiff_t>(row_bytes(format, grey.cols));
    return FrameConverter(format, grey.cols, grey.rows, stride).sharpness(bytes);
  };
  for (const RawFormat& format : formats_of_fixed_size()) {
    EXPECT_GT(grade(format, sharp), 2.0 * grade(format, blurred)) << name(format);
  }
}

// Neighbours in a mosaic have other colours, and what packed formats keep behind each group is no sample.
TEST_F(Converters, SharpnessOfAMosaicComparesEqualColours) {
  cv::Mat noise(120, 160, CV_8UC1);
  cv::randu(noise, 0, 56);
  cv::Mat blurred;
  cv::GaussianBlur(noise, blurred, {5, 5}, 1.0);
  const auto grade = [this](const RawFormat& format, const cv::Mat& grey) {
    cv::Mat_<std::uint16_t> samples(grey.rows, grey.cols);
    for (int y = 0; y < grey.rows; ++y) {
      for (int x = 0; x < grey.cols; ++x) {
        const int level = grey.at<std::uint8_t>(y, x) + ((x + y) % 2 == 0 ? 200 : 50);
        samples(y, x) = static_cast<std::uint16_t>(level << (format.bits - 8));
        samples(y, x) = static_cast<std::uint16_t>(samples(y, x) + draw(0, (1 << (format.bits - 8)) - 1));
      }
    }
    const auto stride = static_cast<std::ptrdiff_t>(row_bytes(format, grey.cols));
    return FrameConverter(format, grey.cols, grey.rows, stride).sharpness(store(format, samples, stride));
  };
  for (const auto& [bits, is_packed] : {std::pair{8, false}, std::pair{10, false}, std::pair{12, false},
                                        std::pair{10, true}, std::pair{12, true}}) {
    const RawFormat format{RawEncoding::bayer, BayerPattern::rggb, bits, is_packed};
    EXPECT_EQ(grade(format, cv::Mat::zeros(120, 160, CV_8UC1)), 0.0) << name(format);
    EXPECT_GT(grade(format, noise), 2.0 * grade(format, blurred)) << name(format);
  }
}

TEST_F(Converters, BrightnessIsTheMeanGrey) {
  for (const int level : {0, 60, 255}) {
    for (const RawFormat& format : formats_of_fixed_size()) {
      const auto stride = static_cast<std::ptrdiff_t>(row_bytes(format, 32));
      std::vector<std::uint8_t> bytes(frame_bytes(format, 32, 24, stride), static_cast<std::uint8_t>(level));
      if (format.encoding == RawEncoding::yuyv)
        for (std::size_t i = 1; i < bytes.size(); i += 2) bytes[i] = 128;
      EXPECT_EQ(FrameConverter(format, 32, 24, stride).brightness(bytes), level) << name(format);
    }
    const RawFormat format{RawEncoding::bayer, BayerPattern::rggb, 10, true};
    const auto stride = static_cast<std::ptrdiff_t>(row_bytes(format, 32));
    const cv::Mat_<std::uint16_t> samples(24, 32, static_cast<std::uint16_t>(level << 2));
    EXPECT_EQ(FrameConverter(format, 32, 24, stride).brightness(store(format, samples, stride)), level);
  }
}

TEST(Fingerprint, ChangesWithEveryByte) {
  std::vector<std::uint8_t> bytes(1003, 7);
  const std::uint64_t whole = fingerprint(bytes);
  for (const std::size_t at : {std::size_t{0}, std::size_t{500}, std::size_t{1000}, std::size_t{1002}}) {
    bytes[at] ^= 1;
    EXPECT_NE(fingerprint(bytes), whole) << at;
    bytes[at] ^= 1;
  }
  EXPECT_EQ(fingerprint(bytes), whole);
  EXPECT_NE(fingerprint(std::span(bytes).first(1002)), whole);
}

}  // namespace
}  // namespace traygauge
