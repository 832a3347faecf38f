#include "drivers/pixels/jpeg_decoder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <random>

#include "drivers/pixels/frame_converter.hpp"

namespace traygauge {
namespace {

constexpr int kWidth = 320;
constexpr int kHeight = 240;

std::vector<std::uint8_t> encode(int seed, int quality = 90) {
  cv::Mat picture(kHeight / 8, kWidth / 8, CV_8UC3);
  cv::theRNG().state = static_cast<std::uint64_t>(seed) + 1;
  cv::randu(picture, 0, 256);
  cv::resize(picture, picture, {kWidth, kHeight}, 0, 0, cv::INTER_CUBIC);
  std::vector<std::uint8_t> bytes;
  cv::imencode(".jpg", picture, bytes, {cv::IMWRITE_JPEG_QUALITY, quality});
  return bytes;
}

class Jpeg : public testing::Test {
 protected:
  bool decode(std::span<const std::uint8_t> bytes) {
    return decoder_.decode(bytes, kWidth, kHeight, rgb_.data());
  }
  JpegDecoder decoder_;
  std::vector<std::uint8_t> rgb_ = std::vector<std::uint8_t>(std::size_t{kWidth} * kHeight * 3);
};

TEST_F(Jpeg, DecodesAsOpenCvDoesPictureAfterPicture) {
  for (int seed = 0; seed < 5; ++seed) {
    const auto bytes = encode(seed);
    ASSERT_TRUE(decode(bytes)) << decoder_.problem();
    cv::Mat theirs;
    cv::cvtColor(cv::imdecode(bytes, cv::IMREAD_COLOR), theirs, cv::COLOR_BGR2RGB);
    const cv::Mat ours(kHeight, kWidth, CV_8UC3, rgb_.data());
    EXPECT_EQ(cv::norm(ours, theirs, cv::NORM_INF), 0.0) << "seed " << seed;
  }
}

// Motion JPEG leaves the usual Huffman tables out.
TEST_F(Jpeg, DecodesPicturesWithoutHuffmanTables) {
  const auto bytes = encode(1);
  ASSERT_TRUE(decode(bytes));
  const auto with_tables = rgb_;
  std::vector<std::uint8_t> without = {bytes[0], bytes[1]};
  std::size_t at = 2;
  while (bytes.at(at + 1) != 0xDA) {
    const std::size_t length = 2 + std::size_t{bytes[at + 2]} * 256 + bytes[at + 3];
    if (bytes[at + 1] != 0xC4) without.insert(without.end(), &bytes[at], &bytes[at] + length);
    at += length;
  }
  without.insert(without.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at), bytes.end());
  ASSERT_LT(without.size(), bytes.size());
  ASSERT_TRUE(decode(without)) << decoder_.problem();
  EXPECT_EQ(rgb_, with_tables);
}

TEST_F(Jpeg, KnowsWhereAPictureEnds) {
  const auto whole = encode(2);
  const std::size_t length = whole.size();
  std::mt19937 random(7);
  for (const std::size_t behind : {0U, 1U, 2U, 300U, 700U}) {
    for (const bool is_noise : {false, true}) {
      auto bytes = whole;
      for (std::size_t i = 0; i < behind; ++i)
        bytes.push_back(is_noise ? static_cast<std::uint8_t>(random()) : 0);
      EXPECT_EQ(find_jpeg(bytes).length, length) << behind;
      EXPECT_TRUE(find_jpeg(bytes).has_end) << behind;
    }
  }
  for (const std::size_t missing : {1U, 2U}) {
    const JpegExtent extent = find_jpeg(std::span(whole).first(length - missing));
    EXPECT_EQ(extent.length, length - 2);
    EXPECT_FALSE(extent.has_end);
  }
  EXPECT_FALSE(find_jpeg(std::span(whole).first(length / 2)).has_end);
  EXPECT_EQ(find_jpeg(std::span(whole).subspan(1)).length, 0U);
  EXPECT_EQ(find_jpeg({}).length, 0U);
  const std::vector<std::uint8_t> zeros(100, 0);
  EXPECT_EQ(find_jpeg(zeros).length, 0U);
}

// The end of a thumbnail, which stands in a segment, is not the picture's.
TEST_F(Jpeg, AThumbnailHasAnEndOfItsOwn) {
  const auto thumbnail = encode(1, 10);
  auto bytes = encode(2);
  const std::size_t length = 2 + thumbnail.size();
  ASSERT_LT(length, 65'536U);
  std::vector<std::uint8_t> segment = {0xFF, 0xE1, static_cast<std::uint8_t>(length / 256),
                                       static_cast<std::uint8_t>(length % 256)};
  segment.insert(segment.end(), thumbnail.begin(), thumbnail.end());
  bytes.insert(bytes.begin() + 2, segment.begin(), segment.end());
  EXPECT_EQ(find_jpeg(bytes).length, bytes.size());
  EXPECT_TRUE(decode(bytes)) << decoder_.problem();
}

TEST_F(Jpeg, AMissingEndMarkerIsNoDamageAndAMissingRowIs) {
  for (int seed = 0; seed < 20; ++seed) {
    const auto bytes = encode(seed);
    ASSERT_TRUE(decode(bytes));
    const auto plain = rgb_;
    for (const std::size_t missing : {1U, 2U}) {
      rgb_.assign(rgb_.size(), 0);
      ASSERT_TRUE(decode(std::span(bytes).first(bytes.size() - missing))) << decoder_.problem();
      EXPECT_EQ(rgb_, plain);
    }
    for (const std::size_t missing : {12U, 100U, 1000U}) {
      EXPECT_FALSE(decode(std::span(bytes).first(bytes.size() - missing))) << missing;
    }
  }
}

TEST_F(Jpeg, ACamerasFrameNeedsAllItsRowsAndNoMore) {
  RawFormat format;
  format.encoding = RawEncoding::mjpeg;
  FrameConverter converter(format, kWidth, kHeight, 0, {});
  const auto bytes = encode(3);
  ASSERT_TRUE(decode(bytes));
  const auto plain = rgb_;
  auto behind = bytes;
  behind.insert(behind.end(), 700, 0x5A);
  const std::span without_end = std::span(bytes).first(bytes.size() - 2);
  for (const std::span<const std::uint8_t> frame : {std::span<const std::uint8_t>(behind), without_end}) {
    EXPECT_TRUE(converter.is_whole(frame)) << converter.problem();
    rgb_.assign(rgb_.size(), 0);
    EXPECT_TRUE(converter.convert(frame, rgb_.data())) << converter.problem();
    EXPECT_EQ(rgb_, plain);
  }
  EXPECT_FALSE(converter.is_whole(std::span(bytes).first(bytes.size() / 2)));
  EXPECT_EQ(converter.problem(), "a JPEG picture without its end");
}

TEST_F(Jpeg, RefusesAnotherSizeAndNamesIt) {
  const auto bytes = encode(3);
  EXPECT_FALSE(decoder_.decode(bytes, kWidth, kHeight - 16, rgb_.data()));
  EXPECT_EQ(decoder_.problem(), "a picture of 320 x 240");
  EXPECT_TRUE(decode(bytes));
}

// A part that is missing although begin and end are there: what a lost transfer leaves.
TEST_F(Jpeg, RefusesAPictureWithAHole) {
  const auto bytes = encode(4);
  int refused = 0;
  for (std::size_t share = 1; share < 8; ++share) {
    auto holed = bytes;
    const auto from = holed.begin() + static_cast<std::ptrdiff_t>(holed.size() * share / 8);
    holed.erase(from, from + static_cast<std::ptrdiff_t>(holed.size() / 10));
    if (find_jpeg(holed).length == 0 || !decode(holed)) ++refused;
  }
  EXPECT_EQ(refused, 7);
}

// Several cameras send a few bytes too many before a marker, always.
TEST_F(Jpeg, BytesTooManyBeforeAMarkerChangeNothing) {
  const auto bytes = encode(4);
  ASSERT_TRUE(decode(bytes));
  const auto plain = rgb_;
  for (const bool at_the_end : {false, true}) {
    auto spliced = bytes;
    const auto at = at_the_end ? spliced.end() - 2 : spliced.begin() + 2;
    spliced.insert(at, {0x11, 0x22, 0x33});
    rgb_.assign(rgb_.size(), 0);
    ASSERT_TRUE(decode(spliced)) << decoder_.problem();
    EXPECT_EQ(rgb_, plain);
  }
}

TEST_F(Jpeg, TellsTheBrightnessCheaply) {
  for (int seed = 0; seed < 3; ++seed) {
    const auto bytes = encode(seed);
    const double mean = cv::mean(cv::imdecode(bytes, cv::IMREAD_GRAYSCALE))[0];
    const auto found = decoder_.mean_grey(bytes);
    ASSERT_TRUE(found) << decoder_.problem();
    EXPECT_NEAR(*found, mean, 1.0);
  }
  const auto bytes = encode(4);
  EXPECT_FALSE(decoder_.mean_grey(std::span(bytes).first(bytes.size() / 2)));
  EXPECT_TRUE(decode(encode(4)));
}

TEST_F(Jpeg, AHoleHardlyEverPassesForBytesTooMany) {
  std::mt19937 random(20261123);
  const auto bytes = encode(4);
  int passed = 0;
  for (int run = 0; run < 2000; ++run) {
    auto holed = bytes;
    const std::size_t length = 1 + random() % 4000;
    const auto from =
        holed.begin() + 700 + static_cast<std::ptrdiff_t>(random() % (holed.size() - 700 - length));
    holed.erase(from, from + static_cast<std::ptrdiff_t>(length));
    if (find_jpeg(holed).length > 0 && decode(holed)) ++passed;
  }
  EXPECT_LE(passed, 40) << "more than those that leave no trace at all";
}

TEST_F(Jpeg, SurvivesAnyBytes) {
  std::mt19937 random(20261122);
  const auto bytes = encode(5);
  for (int run = 0; run < 2000; ++run) {
    auto damaged = bytes;
    for (int i = 0; i < 1 + run % 20; ++i) {
      damaged[random() % (run % 3 == 0 ? 700 : damaged.size())] = static_cast<std::uint8_t>(random());
    }
    if (run % 5 == 0) damaged.resize(random() % damaged.size());
    decode(damaged);  // whatever it says, it says it
  }
  EXPECT_TRUE(decode(bytes)) << "usable after every failure: " << decoder_.problem();
}

TEST_F(Jpeg, ConverterSaysWhatIsWrong) {
  FrameConverter converter({RawEncoding::mjpeg}, kWidth, kHeight, 0);
  auto bytes = encode(6);
  ASSERT_TRUE(converter.is_whole(bytes));
  EXPECT_TRUE(converter.convert(bytes, rgb_.data()));
  EXPECT_GT(converter.sharpness(encode(6, 95)), converter.sharpness(encode(6, 60)));
  EXPECT_FALSE(converter.is_whole(std::span(bytes).first(bytes.size() / 2)));
  EXPECT_EQ(converter.problem(), "a JPEG picture without its end");
  std::fill(bytes.begin() + 700, bytes.end() - 2, std::uint8_t{0});
  ASSERT_TRUE(converter.is_whole(bytes));
  EXPECT_FALSE(converter.convert(bytes, rgb_.data()));
  EXPECT_FALSE(converter.problem().empty());
}

}  // namespace
}  // namespace traygauge
