// Label pictures: every way in which tools store them, and what is no label picture.
#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <functional>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "simulator/capture/capture.hpp"
#include "simulator/capture/label_specks.hpp"
#include "simulator/capture/output_file.hpp"
#include "simulator/capture/picture_file.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

constexpr PictureSize kLabelSize{TemporaryCapture::kWidth, TemporaryCapture::kHeight};

std::string label_problem(const std::function<void()>& reading) {
  try {
    reading();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

void expect_labels(const Picture& labels, const cv::Mat& expected) {
  ASSERT_EQ(labels.pixels.size(), expected.total());
  EXPECT_TRUE(std::equal(labels.pixels.begin(), labels.pixels.end(), expected.begin<std::uint8_t>()));
}

// Indices with VOC's colours, as labelme stores them; OpenCV writes no palettes.
void write_palette_png(const std::filesystem::path& file, const cv::Mat& labels) {
  write_stream(file, [&labels](std::FILE* stream) {
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, stream);
    std::array<png_color, 256> palette{};
    for (std::size_t i = 0; i < palette.size(); ++i) {
      const auto shade = static_cast<png_byte>(255 - i);
      palette[i] = {shade, static_cast<png_byte>(i * 7), 128};
    }
    png_set_IHDR(png, info, static_cast<png_uint_32>(labels.cols), static_cast<png_uint_32>(labels.rows), 8,
                 PNG_COLOR_TYPE_PALETTE, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_set_PLTE(png, info, palette.data(), static_cast<int>(palette.size()));
    png_write_info(png, info);
    for (int y = 0; y < labels.rows; ++y) png_write_row(png, labels.ptr(y));
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return true;
  });
}

class Labels : public testing::Test {
 protected:
  Picture read(const char* name) const { return read_label_picture({files_.file(name), "key"}, kLabelSize); }
  std::string problem(const char* name) const {
    return label_problem([&] { read(name); });
  }
  // Of a picture with these labels.
  std::string speck_problem(const cv::Mat& labels) {
    return label_problem([&] { clean(labels); });
  }
  Picture clean(const cv::Mat& labels) {
    cv::imwrite(files_.file("tried.png").string(), labels);
    Picture picture = read("tried.png");
    warnings_.clear();
    ignore_specks({files_.file("tried.png"), "key"}, picture, warnings_);
    return picture;
  }

  TemporaryCapture files_;
  cv::Mat labels_ = draw_labels(kLabelSize.width, kLabelSize.height);
  std::vector<InputWarning> warnings_;
};

TEST_F(Labels, AreReadAsStored) {
  expect_labels(read("labels_1.png"), labels_);
}

TEST_F(Labels, APalettesIndexIsTheLabel) {
  write_palette_png(files_.file("palette.png"), labels_);
  ASSERT_NE(cv::imread(files_.file("palette.png").string(), cv::IMREAD_UNCHANGED).channels(), 1);
  expect_labels(read("palette.png"), labels_);
}

TEST_F(Labels, FewBitsAreNotStretched) {
  const cv::Mat dish = labels_ == 1;
  cv::imwrite(files_.file("bits.png").string(), dish, {cv::IMWRITE_PNG_BILEVEL, 1});
  expect_labels(read("bits.png"), dish / 255);
}

TEST_F(Labels, EqualColoursAreLabels) {
  cv::Mat colours;
  cv::cvtColor(labels_, colours, cv::COLOR_GRAY2BGR);
  cv::imwrite(files_.file("rgb.png").string(), colours);
  expect_labels(read("rgb.png"), labels_);
  cv::cvtColor(labels_, colours, cv::COLOR_GRAY2BGRA);
  colours.at<cv::Vec4b>(0, 0) = {255, 255, 255, 0};
  cv::imwrite(files_.file("rgba.png").string(), colours);
  expect_labels(read("rgba.png"), labels_);
}

TEST_F(Labels, SixteenBitsAreLabelsUpTo255) {
  cv::Mat deep;
  labels_.convertTo(deep, CV_16U);
  cv::imwrite(files_.file("deep.png").string(), deep);
  expect_labels(read("deep.png"), labels_);
  deep.at<std::uint16_t>(7, 5) = 256;
  cv::imwrite(files_.file("deep.png").string(), deep);
  EXPECT_NE(problem("deep.png").find("found 256 at x 5, y 7"), std::string::npos) << problem("deep.png");
}

TEST_F(Labels, OtherKindsAreRefused) {
  cv::Mat colours;
  cv::cvtColor(labels_, colours, cv::COLOR_GRAY2BGR);
  colours.at<cv::Vec3b>(3, 2) = {0, 0, 128};
  cv::imwrite(files_.file("drawn.png").string(), colours);
  EXPECT_NE(problem("drawn.png").find("the colour 128 0 0 at x 2, y 3"), std::string::npos)
      << problem("drawn.png");
  EXPECT_NE(problem("view_0.jpg").find("a JPEG picture"), std::string::npos);
  write_text(files_.file("text.png"), "labels");
  EXPECT_NE(problem("text.png").find("bytes of another kind"), std::string::npos);
  cv::imwrite(files_.file("half.png").string(), draw_labels(160, 120));
  EXPECT_NE(problem("half.png").find("160x120 pixels"), std::string::npos);
}

TEST_F(Labels, SharpOnesAreLeftAlone) {
  expect_labels(clean(labels_), labels_);
  EXPECT_TRUE(warnings_.empty());
}

TEST_F(Labels, SmoothedOnesAreRefusedWithTheirLabels) {
  for (const double sigma_px : {0.5, 0.8, 1.5, 3.0}) {
    cv::Mat soft;
    cv::GaussianBlur(labels_, soft, {0, 0}, sigma_px);
    const std::string problem = speck_problem(soft);
    EXPECT_NE(problem.find("tried.png"), std::string::npos) << sigma_px;
    EXPECT_NE(problem.find("labels with sharp edges"), std::string::npos) << problem;
    EXPECT_NE(problem.find("pixels)"), std::string::npos) << problem;
  }
}

TEST_F(Labels, OnesThatWereJpegOnceAreRefused) {
  for (const int quality : {50, 75, 90, 95}) {
    std::vector<std::uint8_t> bytes;
    cv::imencode(".jpg", labels_, bytes, {cv::IMWRITE_JPEG_QUALITY, quality});
    EXPECT_NE(speck_problem(cv::imdecode(bytes, cv::IMREAD_UNCHANGED)), "") << quality;
  }
}

TEST_F(Labels, AFewStraySpecksAreIgnored) {
  cv::Mat stray = labels_.clone();
  stray.at<std::uint8_t>(200, 10) = 7;     // of no item, on the background
  stray.at<std::uint8_t>(60, 160) = 3;     // of an item, far from it, on the dish
  stray(cv::Rect(290, 220, 2, 2)) = 1;     // of the dish, on the background
  stray.at<std::uint8_t>(120, 120) = 203;  // of no dish, in an item
  stray.at<std::uint8_t>(230, 0) = 9;      // at the edge
  expect_labels(clean(stray), labels_);
  ASSERT_EQ(warnings_.size(), 1U);
  EXPECT_EQ(warnings_[0].code, "labels_specks");
  EXPECT_NE(warnings_[0].message.find("1, 3, 7, 9, 203 (8 pixels)"), std::string::npos)
      << warnings_[0].message;
}

TEST_F(Labels, SmallHonestItemsStay) {
  cv::Mat small = labels_.clone();
  small(cv::Rect(150, 60, 3, 3)) = 4;    // the smallest with a middle
  small(cv::Rect(120, 175, 70, 1)) = 5;  // thin, but as large as an item
  small(cv::Rect(158, 100, 4, 30)) = 1;  // the dish between two foods
  small(cv::Rect(100, 119, 20, 2)) = 1;  // and within one
  expect_labels(clean(small), small);
  EXPECT_TRUE(warnings_.empty());
}

TEST_F(Labels, PartsBesideTheirItemStay) {
  cv::Mat parts = labels_.clone();
  const cv::Rect item(120 - 30, 120 - 30, 60, 60);
  ASSERT_EQ(parts.at<std::uint8_t>(120, 120), 2);
  // Item 2 ends in separate pixels, as behind a fork.
  for (int x = item.x; x < item.x + item.width; x += 3) {
    int y = item.y;
    while (parts.at<std::uint8_t>(y, x) != 2) ++y;
    if (y >= 4) parts.at<std::uint8_t>(y - 3, x) = 2;
  }
  expect_labels(clean(parts), parts);
}

TEST_F(Labels, NoisePaintsOverNothingButSpecks) {
  cv::RNG random(test::random_seed());
  for (int round = 0; round < 50; ++round) {
    cv::Mat noisy = labels_.clone();
    for (int i = 0; i < 8; ++i) {
      noisy.at<std::uint8_t>(random.uniform(0, noisy.rows), random.uniform(0, noisy.cols)) =
          static_cast<std::uint8_t>(random.uniform(4, 200));
    }
    Picture cleaned = clean(noisy);
    const cv::Mat result(noisy.rows, noisy.cols, CV_8UC1, cleaned.pixels.data());
    EXPECT_LE(cv::countNonZero(result != labels_), 8);  // at an edge the other side may be painted
    EXPECT_EQ(cv::countNonZero((result > 3) & (result < 200)), 0);
  }
}

}  // namespace
}  // namespace traygauge
