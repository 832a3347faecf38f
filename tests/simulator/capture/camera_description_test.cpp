// Cameras as people describe them: coefficients of every count, calibration files as OpenCV writes them,
// values of another picture size, and what fits no camera.
#include "simulator/capture/camera_description.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <numeric>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "simulator/capture/capture.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"

namespace traygauge {
namespace {

using Json = nlohmann::json;

class CameraOfCapture : public testing::Test {
 protected:
  CameraDescription camera() {
    files_.store();
    capture_ = read_capture(files_.folder());
    return capture_.views[0].camera;
  }
  std::string camera_problem() {
    try {
      camera();
      load_view(capture_.views[0]);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  Json& values() { return files_.document["camera"]; }
  // As cv::FileStorage writes them, by the file's name.
  void write_calibration(const char* name, int coefficients, int type = CV_64F) const {
    cv::FileStorage storage(files_.file(name).string(), cv::FileStorage::WRITE);
    const cv::Mat matrix = (cv::Mat_<double>(3, 3) << 301.25, 0, 158.5, 0, 302.5, 121.75, 0, 0, 1);
    cv::Mat distortion(coefficients, 1, CV_64F);
    for (int i = 0; i < coefficients; ++i) distortion.at<double>(i) = 0.01 * (i + 1);
    cv::Mat stored;
    distortion.convertTo(stored, type);
    storage << "calibration_time"
            << "Fri 27 Nov 2026 10:00:00"
            << "image_width" << 320 << "image_height" << 240 << "camera_matrix" << matrix
            << "distortion_coefficients" << stored << "avg_reprojection_error" << 0.2;
  }
  void expect_calibration(const CameraDescription& read, int coefficients, double tolerance = 0.0) const {
    EXPECT_EQ(read.size, (PictureSize{320, 240}));
    EXPECT_EQ(read.fx_px, 301.25);
    EXPECT_EQ(read.fy_px, 302.5);
    EXPECT_EQ(read.cx_px, 158.5);
    EXPECT_EQ(read.cy_px, 121.75);
    for (int i = 0; i < 14; ++i) {
      const double value = i < 5 ? read.distortion.at(static_cast<std::size_t>(i))
                                 : read.further_distortion.at(static_cast<std::size_t>(i - 5));
      EXPECT_NEAR(value, i < coefficients ? 0.01 * (i + 1) : 0.0, tolerance) << i;
    }
  }

  TemporaryCapture files_;
  Capture capture_;
};

TEST_F(CameraOfCapture, EveryCountOfCoefficientsIsRead) {
  for (const std::size_t count : {4U, 5U, 8U, 12U, 14U}) {
    std::vector<double> coefficients(count);
    std::iota(coefficients.begin(), coefficients.end(), 1.0);
    Json column = Json::array();
    for (const double value : coefficients) column.push_back({value});
    const Json matrix = {
        {"type_id", "opencv-matrix"}, {"rows", 1}, {"cols", count}, {"dt", "d"}, {"data", coefficients}};
    for (const Json& form : {Json(coefficients), Json::array({coefficients}), column, matrix}) {
      values()["distortion"] = form;
      const CameraDescription read = camera();
      for (std::size_t i = 0; i < 14; ++i) {
        const double value = i < 5 ? read.distortion.at(i) : read.further_distortion.at(i - 5);
        EXPECT_EQ(value, i < count ? static_cast<double>(i + 1) : 0.0) << form;
      }
      EXPECT_EQ(read.has_further_distortion(), count > 5);
      EXPECT_EQ(read.coefficients().size(), std::max<std::size_t>(count, 5));
    }
  }
}

TEST_F(CameraOfCapture, OtherCountsAreRefusedWithThoseThatThereAre) {
  for (const std::size_t count : {0U, 1U, 3U, 6U, 13U, 15U}) {
    values()["distortion"] = std::vector<double>(count, 0.0);
    EXPECT_NE(camera_problem().find("camera.distortion: expected"), std::string::npos) << camera_problem();
  }
  values()["distortion"] = std::vector<double>(6, 0.0);
  EXPECT_NE(camera_problem().find("4, 5, 8, 12 or 14 coefficients"), std::string::npos) << camera_problem();
  values()["distortion"] = "none";
  EXPECT_NE(camera_problem().find("4, 5, 8, 12 or 14 coefficients"), std::string::npos) << camera_problem();
}

TEST_F(CameraOfCapture, AFileOfOpenCvIsReadAsItIs) {
  for (const char* name : {"camera.yml", "camera.yaml", "camera.xml", "camera.json"}) {
    for (const int count : {4, 5, 8, 12, 14}) {
      write_calibration(name, count);
      files_.document["camera"] = name;
      expect_calibration(camera(), count);
      files_.document["camera"] = {{"file", name}};
      expect_calibration(camera(), count);
    }
    write_calibration(name, 5, CV_32F);
    expect_calibration(camera(), 5, 1e-7);
  }
}

TEST_F(CameraOfCapture, FilesOfOtherProgramsAreRead) {
  write_text(files_.file("ros.yaml"),
             "image_width: 320\nimage_height: 240\ncamera_name: tray\ncamera_matrix:\n  rows: 3\n  cols: 3\n"
             "  data: [301.25, 0.0, 158.5, 0.0, 302.5, 121.75, 0.0, 0.0, 1.0]\ndistortion_model: plumb_bob\n"
             "distortion_coefficients:\n  rows: 1\n  cols: 5\n  data: [0.01, 0.02, 0.03, 0.04, 0.05]\n"
             "projection_matrix:\n  rows: 3\n  cols: 4\n  data: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0]\n");
  files_.document["camera"] = "ros.yaml";
  expect_calibration(camera(), 5);
  // PyYAML of the nested lists that OpenCV's tutorial makes; it does not say the size.
  write_text(files_.file("tutorial.yaml"),
             "camera_matrix:\n- - 301.25\n  - 0.0\n  - 158.5\n- - 0.0\n  - 302.5\n  - 121.75\n- - 0.0\n  - "
             "0.0\n  - 1.0\n"
             "dist_coeff:\n- - 0.01\n  - 0.02\n  - 0.03\n  - 0.04\n  - 0.05\n");
  files_.document["camera"] = {{"file", "tutorial.yaml"}, {"width", 320}, {"height", 240}};
  expect_calibration(camera(), 5);
  files_.document["camera"] = "tutorial.yaml";
  EXPECT_NE(camera_problem().find("tutorial.yaml: image_width"), std::string::npos) << camera_problem();
  write_text(files_.file("numpy.json"), R"({"mtx": [[301.25, 0, 158.5], [0, 302.5, 121.75], [0, 0, 1]],
    "dist": [[0.01, 0.02, 0.03, 0.04, 0.05]], "imageSize": [320, 240]})");
  files_.document["camera"] = "numpy.json";
  expect_calibration(camera(), 5);
}

TEST_F(CameraOfCapture, UnusableCalibrationFilesAreNamed) {
  const auto expect_problem = [&](const std::string& text, const std::string& problem) {
    write_text(files_.file("bad.yml"), text);
    files_.document["camera"] = "bad.yml";
    EXPECT_NE(camera_problem().find("bad.yml"), std::string::npos) << camera_problem();
    EXPECT_NE(camera_problem().find(problem), std::string::npos) << camera_problem();
  };
  write_calibration("good.yml", 5);
  const std::string good = read_text(files_.file("good.yml"));
  const auto replaced = [&good](const std::string& from, const std::string& to) {
    std::string text = good;
    return text.replace(text.find(from), from.size(), to);
  };
  expect_problem("", "camera_matrix");
  expect_problem("no calibration", "camera_matrix");
  expect_problem(replaced("distortion_coefficients", "something_else"), "distortion_coefficients");
  expect_problem(replaced("image_width: 320", "image_width: 0"), "image_width");
  expect_problem(replaced("data: [", "data: [ .Nan,"), "found .Nan");
  expect_problem(replaced("data: [", "data: [ 1.0,"), "found 10 numbers");
  expect_problem(
      "image_width: 320\nimage_height: 240\nK: [3.25, 0, 160, 0, 3.25, 120, 0, 0, 1]\nD: [0, 0, 0, 0]\n",
      "fx: expected a focal length in pixels");
  expect_problem(replaced("rows: 5", "rows: 3") + "distortion_model: fisheye\n", "found fisheye");
  files_.document["camera"] = "../bad.yml";
  EXPECT_NE(camera_problem().find("inside the capture's folder"), std::string::npos);
  files_.document["camera"] = "absent.yml";
  EXPECT_NE(camera_problem().find("No such file"), std::string::npos);
}

TEST_F(CameraOfCapture, NoTruncatedCalibrationFileCrashes) {
  for (const char* name : {"camera.yml", "camera.xml", "camera.json"}) {
    write_calibration(name, 14);
    const std::string whole = read_text(files_.file(name));
    files_.document["camera"] = name;
    for (std::size_t size = 0; size < whole.size(); size += 7) {
      write_text(files_.file(name), whole.substr(0, size));
      camera_problem();
    }
  }
}

TEST_F(CameraOfCapture, ValuesOfAnotherPictureSizeAreScaled) {
  for (const double factor : {0.25, 0.5, 0.75, 1.5, 2.0, 4.0}) {
    files_.document["camera"] = {{"width", std::lround(320 * factor)},
                                 {"height", std::lround(240 * factor)},
                                 {"fx", 300.0 * factor},
                                 {"fy", 310.0 * factor},
                                 {"cx", 160.0 * factor - 0.5},
                                 {"cy", 121.0 * factor - 0.5},
                                 {"distortion", {0.1, 0.0, 0.0, 0.0, 0.0}}};
    const CameraDescription read = camera();
    EXPECT_EQ(read.size, (PictureSize{320, 240})) << factor;
    EXPECT_NEAR(read.fx_px, 300.0, 1e-9);
    EXPECT_NEAR(read.fy_px, 310.0, 1e-9);
    EXPECT_NEAR(read.cx_px, 159.5, 1e-9);
    EXPECT_NEAR(read.cy_px, 120.5, 1e-9);
    EXPECT_EQ(read.distortion[0], 0.1);
    const LoadedView view = load_view(capture_.views[0]);
    ASSERT_EQ(view.warnings.size(), 1U);
    EXPECT_EQ(view.warnings[0].code, "camera_scaled");
    EXPECT_NE(view.warnings[0].message.find("camera: the camera's values are for pictures of"),
              std::string::npos)
        << view.warnings[0].message;
  }
}

TEST_F(CameraOfCapture, ValuesThatContradictTheirOwnSizeAreScaled) {
  for (const double factor : {0.25, 0.5, 2.0}) {
    for (const auto& [key, value] : {std::pair{"fx", 300.0}, {"fy", 300.0}, {"cx", 162.0}, {"cy", 118.0}}) {
      values()[key] = value * factor;
    }
    const CameraDescription read = camera();
    EXPECT_NEAR(read.fx_px, 300.0, 1e-9) << factor;
    EXPECT_NEAR(read.cx_px, 162.0, 1.5);
    ASSERT_EQ(capture_.views[0].warnings.size(), 1U);
    EXPECT_NE(capture_.views[0].warnings[0].message.find("not of 320x240"), std::string::npos)
        << capture_.views[0].warnings[0].message;
  }
}

TEST_F(CameraOfCapture, AnotherAspectIsTheCamerasFault) {
  values()["width"] = 320;
  values()["height"] = 200;
  values()["cy"] = 99.5;
  EXPECT_NE(camera_problem().find("capture.json: camera.width: expected a camera for pictures of 320x240"),
            std::string::npos)
      << camera_problem();
  EXPECT_NE(camera_problem().find("found 320x200"), std::string::npos) << camera_problem();
}

TEST_F(CameraOfCapture, WhatFitsNoCameraIsTheCamerasFault) {
  const Json good = values();
  const auto expect_problem = [&](const Json& changes, const std::string& problem) {
    values() = good;
    values().update(changes);
    EXPECT_NE(camera_problem().find(problem), std::string::npos) << camera_problem();
  };
  expect_problem({{"cx", 119.5}, {"cy", 159.5}}, "camera.cx: expected a principal point near 160, 120");
  expect_problem({{"cx", 119.5}, {"cy", 159.5}}, "exchange the two");
  expect_problem({{"fx", 4.2}, {"fy", 4.2}}, "camera.fx: expected a focal length in pixels, 64 to 6400");
  expect_problem({{"fx", 9e5}}, "camera.fx");
  expect_problem({{"fy", 30.0}}, "camera.fy");
  expect_problem({{"fy", 600.0}}, "camera.fy: expected about fx, 300");
  expect_problem({{"cx", 500.0}}, "camera.cx: expected a number from 0 to 319");
  expect_problem({{"cy", -3.0}}, "camera.cy");
  values() = good;
  values().update({{"cx", 110.0}, {"cy", 90.0}});  // a cut picture
  EXPECT_EQ(camera_problem(), "");
  EXPECT_TRUE(capture_.views[0].warnings.empty());
}

// A camera that stands on its side notes it in EXIF; whoever outlines the picture sees it turned.
TEST_F(CameraOfCapture, LabelsThatFollowAnExifRotationAreNamed) {
  std::string jpeg = read_text(files_.file("view_0.jpg"));
  const std::string exif(
      "\xFF\xE1\x00\x22"
      "Exif\0\0MM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0\x06\0\0\0\0\0\0",
      36);
  jpeg.insert(2, exif);
  write_text(files_.file("view_0.jpg"), jpeg);
  EXPECT_EQ(camera_problem(), "") << "labels of the picture as stored";
  cv::imwrite(files_.file("labels_0.png").string(), draw_labels(240, 320));
  EXPECT_NE(camera_problem().find("labels_0.png"), std::string::npos) << camera_problem();
  EXPECT_NE(camera_problem().find("EXIF orientation 6"), std::string::npos) << camera_problem();
  std::swap(values()["width"], values()["height"]);
  std::swap(values()["cx"], values()["cy"]);
  EXPECT_NE(camera_problem().find("camera.width"), std::string::npos) << camera_problem();
  EXPECT_NE(camera_problem().find("EXIF orientation 6"), std::string::npos) << camera_problem();
}

}  // namespace
}  // namespace traygauge
