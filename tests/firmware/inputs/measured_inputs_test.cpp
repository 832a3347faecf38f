// Captures as people make them, of the demo: what is measured all the same, and what is said of the rest.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "tests/firmware/command_runner.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"
#include "tests/support/temporary_folder.hpp"

namespace traygauge {
namespace {

using Json = nlohmann::json;

const char* const kDemoCapture = TRAYGAUGE_SOURCE_DIR "/simulator/demo/fish_and_potatoes";

class MeasuredInputs : public testing::Test {
 protected:
  MeasuredInputs() {
    std::filesystem::copy(kDemoCapture, folder_.path());
    document_ = Json::parse(read_text(file("capture.json")));
  }

  std::string file(const std::string& name) const { return (folder_.path() / name).string(); }
  std::string view_file(int view) const { return file("view_" + std::to_string(view) + ".jpg"); }
  std::string label_file(int view) const { return file("labels_" + std::to_string(view) + ".png"); }
  cv::Mat labels(int view) const { return cv::imread(label_file(view), cv::IMREAD_UNCHANGED); }
  void put_labels(int view, const cv::Mat& labels) const {
    std::filesystem::remove(label_file(view));
    cv::imwrite(label_file(view), labels);
  }
  CommandResult measure(const std::vector<std::string>& options = {}) const {
    write_text(file("capture.json"), document_.dump(1));
    std::vector<std::string> arguments = {"measure", folder_.path().string(), "--json"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run(arguments);
  }
  Json measured() const {
    const CommandResult result = measure();
    EXPECT_EQ(result.status, 0) << result.error << result.out;
    return result.status == 0 ? Json::parse(result.out) : Json();
  }
  // Of the demo as it is.
  static const Json& plain() {
    static const Json document = Json::parse(run({"measure", kDemoCapture, "--json"}).out);
    return document;
  }
  static bool warns_of(const Json& document, const std::string& code) {
    const Json& warnings = document["warnings"];
    return std::any_of(warnings.begin(), warnings.end(),
                       [&](const Json& warning) { return warning["code"] == code; });
  }
  static void expect_same_volumes(const Json& found) { EXPECT_EQ(found["items"], plain()["items"]); }
  static void expect_volumes_within(const Json& found, double fraction) {
    const Json& items = plain()["items"];
    ASSERT_EQ(found["items"].size(), items.size());
    for (std::size_t i = 0; i < items.size(); ++i) {
      const double wanted = items[i]["volume_ml"].get<double>();
      EXPECT_EQ(found["items"][i]["label"], items[i]["label"]);
      ASSERT_TRUE(found["items"][i]["volume_ml"].is_number()) << found["items"][i];
      EXPECT_NEAR(found["items"][i]["volume_ml"].get<double>(), wanted, fraction * wanted);
    }
  }

  TemporaryFolder folder_;
  Json document_;
};

TEST_F(MeasuredInputs, LabelsInColoursOfEqualChannelsOr16Bits) {
  cv::Mat stored;
  cv::cvtColor(labels(0), stored, cv::COLOR_GRAY2BGRA);
  put_labels(0, stored);
  labels(1).convertTo(stored, CV_16U);
  put_labels(1, stored);
  expect_same_volumes(measured());
}

TEST_F(MeasuredInputs, SmoothedLabelsAreRefusedByTheirFile) {
  cv::Mat soft;
  cv::GaussianBlur(labels(1), soft, {3, 3}, 0.6);
  put_labels(1, soft);
  const CommandResult result = measure();
  EXPECT_EQ(result.status, 2) << result.out;
  EXPECT_NE(result.error.find("labels_1.png: views[1].labels: expected labels with sharp edges"),
            std::string::npos)
      << result.error;
}

TEST_F(MeasuredInputs, StraySpecksChangeNothing) {
  cv::Mat stray = labels(0);
  stray.at<std::uint8_t>(20, 20) = 90;
  stray.at<std::uint8_t>(1100, 1500) = 3;
  stray(cv::Rect(1500, 30, 2, 2)) = 1;
  put_labels(0, stray);
  const Json found = measured();
  expect_same_volumes(found);
  EXPECT_TRUE(warns_of(found, "labels_specks")) << found["warnings"];
}

TEST_F(MeasuredInputs, CoefficientsOfEveryCountAndInFiles) {
  std::vector<double> coefficients = document_["camera"]["distortion"];
  for (const std::size_t count : {4U, 8U, 14U}) {
    coefficients.resize(count, 0.0);
    document_["camera"]["distortion"] = Json::array({coefficients});
    expect_same_volumes(measured());
  }
  cv::FileStorage storage(file("camera.yml"), cv::FileStorage::WRITE);
  const Json& camera = document_["camera"];
  const cv::Mat matrix = (cv::Mat_<double>(3, 3) << camera["fx"].get<double>(), 0, camera["cx"].get<double>(),
                          0, camera["fy"].get<double>(), camera["cy"].get<double>(), 0, 0, 1);
  storage << "image_width" << 1600 << "image_height" << 1200 << "camera_matrix" << matrix
          << "distortion_coefficients" << cv::Mat(coefficients);
  storage.release();
  document_["camera"] = "camera.yml";
  expect_same_volumes(measured());
}

// The same lens by the larger model: a rational one that is equal to second order, with a sensor that is not
// tilted.
TEST_F(MeasuredInputs, ALensOfTheRationalModel) {
  // (1 + a r²) / (1 + b r²) = 1 + (a - b) r² - b (a - b) r⁴ + …, with k1 = a - b, k2 = -b k1.
  const double k1 = document_["camera"]["distortion"][0];
  const double k2 = document_["camera"]["distortion"][1];
  const double b = -k2 / k1;
  document_["camera"]["distortion"] = {k1 + b, 0.0,  0.0, 0.0, 0.0, b,    0.0,
                                       0.0,    1e-9, 0.0, 0.0, 0.0, 1e-9, 0.0};
  expect_volumes_within(measured(), 0.005);
}

TEST_F(MeasuredInputs, ValuesForHalfTheSize) {
  for (const char* key : {"fx", "fy", "cx", "cy"})
    document_["camera"][key] = 0.5 * document_["camera"][key].get<double>();
  const Json found = measured();
  expect_volumes_within(found, 0.01);
  EXPECT_TRUE(warns_of(found, "camera_scaled")) << found["warnings"];
}

TEST_F(MeasuredInputs, ExchangedCentresNameTheCameraFirst) {
  std::swap(document_["camera"]["cx"], document_["camera"]["cy"]);
  const CommandResult result = measure();
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.error.find("capture.json: camera.cx: expected a principal point near 800, 600"),
            std::string::npos)
      << result.error;
}

TEST_F(MeasuredInputs, PicturesOfTwelveMegapixelsAndTheLargest) {
  const Json camera = document_["camera"];
  for (const cv::Size size : {cv::Size(4000, 3000), cv::Size(8192, 6144)}) {
    const double factor = size.width / 1600.0;
    for (int view = 0; view < 2; ++view) {
      const std::string demo = kDemoCapture;
      cv::Mat large;
      cv::resize(cv::imread(demo + "/view_" + std::to_string(view) + ".jpg"), large, size, 0, 0,
                 cv::INTER_CUBIC);
      std::filesystem::remove(view_file(view));
      cv::imwrite(view_file(view), large);
      cv::resize(cv::imread(demo + "/labels_" + std::to_string(view) + ".png", cv::IMREAD_UNCHANGED), large,
                 size, 0, 0, cv::INTER_NEAREST);
      put_labels(view, large);
    }
    document_["camera"] = camera;
    document_["camera"].update({{"width", size.width},
                                {"height", size.height},
                                {"fx", camera["fx"].get<double>() * factor},
                                {"fy", camera["fy"].get<double>() * factor},
                                {"cx", (camera["cx"].get<double>() + 0.5) * factor - 0.5},
                                {"cy", (camera["cy"].get<double>() + 0.5) * factor - 0.5}});
    expect_volumes_within(measured(), 0.03);
  }
}

TEST_F(MeasuredInputs, JpegsWithoutTheirEndAndWithMoreBehindIt) {
  const std::string first = read_text(view_file(0));
  const std::string second = read_text(view_file(1));
  write_text(view_file(0), first.substr(0, first.size() - 2));
  write_text(view_file(1), second + std::string(700, 'Z'));
  const Json found = measured();
  expect_same_volumes(found);
  EXPECT_TRUE(warns_of(found, "picture_end_missing")) << found["warnings"];
}

TEST_F(MeasuredInputs, ACardThatNobodyOutlined) {
  for (const int number : {0, 9}) {
    for (int view = 0; view < 2; ++view) {
      cv::Mat changed = labels(view);
      changed.setTo(number, (changed == 255) | (changed == 9));
      put_labels(view, changed);
    }
    const Json found = measured();
    expect_volumes_within(found, 0.02);
    EXPECT_TRUE(warns_of(found, "card_outline_found")) << found["warnings"];
  }
}

TEST_F(MeasuredInputs, ACardThatIsNotThereIsAskedFor) {
  for (int view = 0; view < 2; ++view) {
    cv::Mat changed = labels(view);
    cv::Mat picture = cv::imread(view_file(view));
    const cv::Mat card = changed == 255;
    cv::Mat around;
    cv::dilate(card, around, cv::Mat::ones(25, 25, CV_8U));
    picture.setTo(cv::mean(picture, around & ~card), around);
    std::filesystem::remove(view_file(view));
    cv::imwrite(view_file(view), picture);
    changed.setTo(0, card);
    put_labels(view, changed);
  }
  const CommandResult result = measure();
  EXPECT_EQ(result.status, 1) << result.error;
  const Json found = Json::parse(result.out);
  EXPECT_EQ(found["status"], "no_card_label");
  EXPECT_NE(found["message"].get<std::string>().find("outline the card"), std::string::npos)
      << found["message"];
}

}  // namespace
}  // namespace traygauge
