// Pictures in and out, with OpenCV's codecs as the oracle.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <random>
#include <string>

#include "simulator/capture/capture.hpp"
#include "simulator/capture/picture_file.hpp"
#include "simulator/capture/png_writer.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"

namespace traygauge {
namespace {

constexpr PictureSize kSize{TemporaryCapture::kWidth, TemporaryCapture::kHeight};

cv::Mat to_mat(const Picture& picture) {
  const bool gray = picture.format == PixelFormat::gray8;
  cv::Mat mat(picture.size.height, picture.size.width, gray ? CV_8UC1 : CV_8UC3);
  std::copy(picture.pixels.begin(), picture.pixels.end(), mat.data);
  if (!gray) cv::cvtColor(mat, mat, cv::COLOR_RGB2BGR);
  return mat;
}

void expect_equal(const cv::Mat& ours, const cv::Mat& oracle, const std::string& what) {
  ASSERT_FALSE(oracle.empty()) << what;
  ASSERT_EQ(ours.size(), oracle.size()) << what;
  ASSERT_EQ(ours.type(), oracle.type()) << what;
  EXPECT_EQ(cv::norm(ours, oracle, cv::NORM_INF), 0.0) << what;
}

cv::Mat oracle_of(const std::filesystem::path& file) {
  return cv::imread(file.string(), cv::IMREAD_ANYCOLOR | cv::IMREAD_IGNORE_ORIENTATION);
}

std::string found_in(const std::function<void()>& reading) {
  try {
    reading();
  } catch (const InputError& error) {
    return error.problem().found;
  }
  return "";
}

TEST(Picture, JpegAndPngEqualTheOracle) {
  const TemporaryFolder folder;
  for (const int type : {CV_8UC1, CV_8UC3}) {
    for (const char* name : {"a.jpg", "a.png"}) {
      for (const cv::Size size : {cv::Size(320, 240), cv::Size(17, 16), cv::Size(131, 97)}) {
        const auto file = folder.path() / name;
        cv::imwrite(file.string(), draw_noise(size.width, size.height, type, 3));
        expect_equal(to_mat(read_picture({file, ""})), oracle_of(file), std::string(name));
      }
    }
  }
}

TEST(Picture, ProgressiveJpegAndReducedPngEqualTheOracle) {
  const TemporaryFolder folder;
  const cv::Mat noise = draw_noise(kSize.width, kSize.height, CV_8UC3, 4);
  const auto jpeg = folder.path() / "p.jpg";
  cv::imwrite(jpeg.string(), noise, {cv::IMWRITE_JPEG_PROGRESSIVE, 1, cv::IMWRITE_JPEG_QUALITY, 80});
  expect_equal(to_mat(read_picture({jpeg, ""})), oracle_of(jpeg), "progressive");
  const auto bits = folder.path() / "bits.png";
  cv::imwrite(bits.string(), noise.reshape(1) > 128, {cv::IMWRITE_PNG_BILEVEL, 1});
  expect_equal(to_mat(read_picture({bits, ""})), oracle_of(bits), "one bit");
  cv::Mat transparent;
  cv::cvtColor(noise, transparent, cv::COLOR_BGR2BGRA);
  const auto alpha = folder.path() / "alpha.png";
  cv::imwrite(alpha.string(), transparent);
  expect_equal(to_mat(read_picture({alpha, ""})), noise, "transparency is dropped");
}

TEST(Picture, GrayFollowsTheUsualWeights) {
  const TemporaryCapture files;
  const Picture picture = read_picture({files.file("view_2.png"), ""}, kSize);
  cv::Mat oracle;
  cv::cvtColor(to_mat(picture), oracle, cv::COLOR_BGR2GRAY);
  EXPECT_LE(cv::norm(to_mat(to_gray(picture)), oracle, cv::NORM_INF), 1.0);
}

TEST(Picture, WrittenPngIsReadBack) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "out.png";
  for (const int type : {CV_8UC1, CV_8UC3}) {
    const cv::Mat wide = draw_noise(90, 60, type, 5);
    const cv::Mat part = wide(cv::Rect(10, 10, 61, 43));  // rows with a stride of their own
    const PixelFormat format = type == CV_8UC1 ? PixelFormat::gray8 : PixelFormat::bgr8;
    write_png(file, {part.data, part.cols, part.rows, static_cast<std::ptrdiff_t>(part.step), format});
    expect_equal(oracle_of(file), part, "png");
  }
  EXPECT_THROW(write_png(folder.path() / "absent" / "out.png", {}), OutputError);
}

TEST(Picture, UnusableFilesAreRefused) {
  const TemporaryCapture files;
  const auto read = [&](const char* name) {
    return [&, name] { read_picture({files.file(name), "key"}, kSize); };
  };
  EXPECT_EQ(found_in(read("absent.jpg")), "No such file or directory");
  EXPECT_EQ(found_in(read("")), "a folder or device");
  write_text(files.file("empty.jpg"), "");
  EXPECT_EQ(found_in(read("empty.jpg")), "an empty file");
  write_text(files.file("text.jpg"), "this is no picture");
  EXPECT_EQ(found_in(read("text.jpg")), "bytes of another kind");
  cv::imwrite(files.file("small.png").string(), draw_noise(15, 16, CV_8UC3, 1));
  EXPECT_EQ(found_in(read("small.png")), "15x16 pixels");
  cv::imwrite(files.file("other.jpg").string(), draw_noise(240, 320, CV_8UC3, 1));
  EXPECT_EQ(found_in(read("other.jpg")), "240x320 pixels");
  cv::imwrite(files.file("deep.png").string(), cv::Mat::zeros(240, 320, CV_16UC1));
  EXPECT_EQ(found_in(read("deep.png")), "16-bit grey");
}

TEST(Picture, NoTruncationIsTakenForAPicture) {
  const TemporaryCapture files;
  for (const char* name : {"view_0.jpg", "view_2.png"}) {
    const std::string whole = read_text(files.file(name));
    const std::size_t step = std::max<std::size_t>(whole.size() / 150, 1);
    for (std::size_t size = 0; size + 1 < whole.size(); size += step) {
      write_text(files.file("cut"), whole.substr(0, size));
      EXPECT_THROW(read_picture({files.file("cut"), ""}, kSize), InputError) << name << " cut to " << size;
    }
    // A JPEG without its end marker alone, the last two bytes, is whole.
    const std::size_t marker = std::string(name).ends_with(".jpg") ? 2 : 0;
    for (std::size_t missing = marker + 3; missing > marker; --missing) {
      write_text(files.file("cut"), whole.substr(0, whole.size() - missing));
      EXPECT_THROW(read_picture({files.file("cut"), ""}, kSize), InputError)
          << name << " without " << missing;
    }
    std::string blank = whole;  // the file system kept the length, not the data
    std::fill(blank.begin() + static_cast<std::ptrdiff_t>(blank.size() / 2), blank.end(), '\0');
    write_text(files.file("cut"), blank);
    EXPECT_THROW(read_picture({files.file("cut"), ""}, kSize), InputError) << name;
  }
}

TEST(Picture, AJpegWithoutItsEndMarkerIsWhole) {
  const TemporaryCapture files;
  const std::string progressive = files.file("progressive.jpg").string();
  cv::imwrite(progressive, draw_noise(kSize.width, kSize.height, CV_8UC3, 4),
              {cv::IMWRITE_JPEG_PROGRESSIVE, 1});
  for (const char* name : {"view_0.jpg", "progressive.jpg"}) {
    const cv::Mat oracle = oracle_of(files.file(name));
    const std::string whole = read_text(files.file(name));
    for (const std::size_t missing : {1U, 2U}) {
      write_text(files.file("cut.jpg"), whole.substr(0, whole.size() - missing));
      std::vector<InputWarning> warnings;
      expect_equal(to_mat(read_picture({files.file("cut.jpg"), ""}, kSize, &warnings)), oracle, name);
      ASSERT_EQ(warnings.size(), 1U) << name;
      EXPECT_EQ(warnings[0].code, "picture_end_missing");
      EXPECT_NE(warnings[0].message.find("cut.jpg"), std::string::npos);
    }
  }
}

// Cut between two scans, no row is missing, and all are coarser than they were.
TEST(Picture, AJpegWithoutItsLastScansIsRefused) {
  const TemporaryCapture files;
  cv::imwrite(files.file("whole.jpg").string(), draw_noise(kSize.width, kSize.height, CV_8UC3, 4),
              {cv::IMWRITE_JPEG_PROGRESSIVE, 1});
  const std::string whole = read_text(files.file("whole.jpg"));
  int scans = 0;
  const std::string scan("\xFF\xDA", 2);
  for (std::size_t at = whole.find(scan); at != std::string::npos; at = whole.find(scan, at + 2), ++scans) {
    // Tables may stand before a scan.
    std::size_t end = at;
    const std::size_t tables = whole.rfind(std::string("\xFF\xC4", 2), at);
    if (tables != std::string::npos && tables + 300 > at) end = tables;
    write_text(files.file("cut.jpg"), whole.substr(0, end));
    EXPECT_THROW(read_picture({files.file("cut.jpg"), ""}, kSize), InputError) << end;
  }
  EXPECT_GT(scans, 3);
}

TEST(Picture, BytesBehindTheEndAndAFewBeforeAMarkerAreAccepted) {
  const TemporaryCapture files;
  const cv::Mat oracle = oracle_of(files.file("view_0.jpg"));
  const std::string whole = read_text(files.file("view_0.jpg"));
  const auto read = [&](const std::string& bytes, std::vector<InputWarning>& warnings) {
    write_text(files.file("odd.jpg"), bytes);
    return to_mat(read_picture({files.file("odd.jpg"), ""}, kSize, &warnings));
  };
  for (const std::size_t behind : {1U, 700U}) {
    std::vector<InputWarning> warnings;
    expect_equal(read(whole + std::string(behind, 'Z'), warnings), oracle, "behind");
    EXPECT_TRUE(warnings.empty());
  }
  std::vector<InputWarning> warnings;
  const std::string body = whole.substr(0, whole.size() - 2);
  const std::string end = whole.substr(whole.size() - 2);
  expect_equal(read(body + "\x11\x22" + end, warnings), oracle, "the decoder does not notice so few");
  warnings.clear();
  expect_equal(read(body + std::string(14, '\x11') + end, warnings), oracle, "before");
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].code, "picture_bytes_too_many");
  EXPECT_THROW(read(body + std::string(200, '\x11') + end, warnings), InputError);
}

TEST(Picture, DamagedBytesNeverCrash) {
  const TemporaryCapture files;
  constexpr unsigned seed = 20260101;
  std::mt19937 random(seed);
  int refused = 0;
  for (const char* name : {"view_0.jpg", "view_2.png", "labels_0.png"}) {
    const std::string whole = read_text(files.file(name));
    for (int round = 0; round < 150; ++round) {
      std::string damaged = whole;
      for (int flips = 0; flips < 4; ++flips)
        damaged[random() % damaged.size()] = static_cast<char>(random());
      write_text(files.file("damaged"), damaged);
      try {
        read_picture({files.file("damaged"), ""}, kSize);
      } catch (const InputError&) {
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, 200) << "seed " << seed;
}

TEST(Depth, SixteenBitsEqualTheOracle) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "depth.png";
  cv::Mat oracle(48, 64, CV_16UC1);
  cv::RNG(7).fill(oracle, cv::RNG::UNIFORM, 0, 65536);
  cv::imwrite(file.string(), oracle);
  const DepthPicture depth = read_depth_picture({file, ""}, {64, 48});
  EXPECT_TRUE(std::equal(depth.pixels.begin(), depth.pixels.end(), oracle.begin<std::uint16_t>()));
}

TEST(RecordedCaptures, PicturesEqualTheOracle) {
  const auto folders = capture_folders();
  if (folders.empty()) GTEST_SKIP() << "TRAYGAUGE_CAPTURES is not set";
  for (std::size_t i = 0; i < folders.size(); i += 3) {
    const Capture capture = read_capture(folders[i]);
    const LoadedView view = load_view(capture.views[0]);
    expect_equal(to_mat(view.picture), oracle_of(capture.views[0].image.path), folders[i].string());
    expect_equal(to_mat(view.labels), oracle_of(capture.views[0].labels->path), folders[i].string());
    expect_equal(to_mat(load_pattern(capture.card)), oracle_of(capture.card.pattern.path),
                 folders[i].string());
  }
}

TEST(RealPhotographs, EqualTheOracleWhateverTheirOrientation) {
  if (captures_folder().empty()) GTEST_SKIP() << "TRAYGAUGE_CAPTURES is not set";
  for (const char* name : {"cards_planar/card_hand_iphone15.jpg", "cards_planar/box.png",
                           "chessboard_opencv_stereo/left01.jpg", "chessboard_phones/mi9se_31.jpg"}) {
    const auto file = captures_folder() / "real" / name;
    expect_equal(to_mat(read_picture({file, ""})), oracle_of(file), name);
  }
}

}  // namespace
}  // namespace traygauge
