// Every bad input through the command line, on copies of a capture with one thing wrong: a status or an error
// that names file or key, and never a volume.
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "tests/firmware/command_runner.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;

// A copy of a capture, to spoil.
class SpoiledCapture {
 public:
  explicit SpoiledCapture(const fs::path& original) {
    for (const auto& entry : fs::directory_iterator(original)) {
      if (entry.is_regular_file()) fs::copy_file(entry.path(), file(entry.path().filename().string()));
    }
    document = nlohmann::json::parse(read_text(file("capture.json")));
  }
  fs::path file(const std::string& name) const { return folder_.path() / name; }
  void store() const { write_text(file("capture.json"), document.dump(1)); }
  CommandResult measure(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {"measure", folder_.path().string(), "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }

  nlohmann::json document;

 private:
  TemporaryFolder folder_;
};

class BadInput : public testing::Test {
 protected:
  void SetUp() override {
    if (captures_folder().empty()) GTEST_SKIP() << "TRAYGAUGE_CAPTURES names no captures";
  }
  static fs::path capture(const std::string& name) { return captures_folder() / name; }

  // Exit 1 with one of the statuses, and no item that was measured.
  static void expect_refusal(const CommandResult& result, const std::vector<std::string>& statuses) {
    ASSERT_EQ(result.status, 1) << result.out << result.error;
    const auto document = nlohmann::json::parse(result.out);
    const std::string status = document.at("status");
    EXPECT_NE(std::find(statuses.begin(), statuses.end(), status), statuses.end()) << status;
    EXPECT_FALSE(document.at("message").get<std::string>().empty());
    for (const auto& item : document.at("items")) EXPECT_TRUE(item.at("volume_ml").is_null()) << item;
  }
  // Exit 2, nothing on standard output, and one line that names each of these.
  static void expect_error(const CommandResult& result, const std::vector<std::string>& named) {
    EXPECT_EQ(result.status, 2) << result.out;
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(std::count(result.error.begin(), result.error.end(), '\n'), 1) << result.error;
    for (const std::string& text : named)
      EXPECT_NE(result.error.find(text), std::string::npos) << result.error;
  }
  static void repaint(const SpoiledCapture& spoiled, const std::string& name,
                      const std::function<void(cv::Mat&)>& paint) {
    cv::Mat picture = cv::imread(spoiled.file(name).string(), cv::IMREAD_UNCHANGED);
    ASSERT_FALSE(picture.empty());
    paint(picture);
    fs::remove(spoiled.file(name));
    ASSERT_TRUE(cv::imwrite(spoiled.file(name).string(), picture));
  }
};

TEST_F(BadInput, TheCopyItselfIsMeasured) {
  const SpoiledCapture good(capture("meals/m01"));
  const CommandResult result = good.measure();
  EXPECT_EQ(result.status, 0) << result.error;
  EXPECT_EQ(nlohmann::json::parse(result.out).at("status"), "ok");
}

TEST_F(BadInput, FilesThatAreMissingCutOrNoPictures) {
  for (const std::string name :
       {"view_0.jpg", "view_1.jpg", "labels_0.png", "labels_1.png", "card.png", "capture.json"}) {
    const SpoiledCapture spoiled(capture("meals/m01"));
    const std::string bytes = read_text(spoiled.file(name));
    write_text(spoiled.file(name), bytes.substr(0, bytes.size() / 2));
    expect_error(spoiled.measure(), {name});
    write_text(spoiled.file(name), "this is no picture and no document");
    expect_error(spoiled.measure(), {name});
    write_text(spoiled.file(name), "");
    expect_error(spoiled.measure(), {name});
    fs::remove(spoiled.file(name));
    expect_error(spoiled.measure(), {name});
  }
  expect_error(run({"measure", "/nonexistent/capture"}), {"/nonexistent/capture"});
}

TEST_F(BadInput, PicturesAndLabelsOfAnotherSize) {
  const auto shrink = [](cv::Mat& picture) { cv::resize(picture, picture, {}, 0.5, 0.5, cv::INTER_NEAREST); };
  for (const std::string name : {"view_0.jpg", "view_1.jpg", "labels_0.png", "labels_1.png"}) {
    const SpoiledCapture spoiled(capture("meals/m01"));
    repaint(spoiled, name, shrink);
    expect_error(spoiled.measure(), {name, "800", "1600"});
  }
}

TEST_F(BadInput, KeysThatAreAbsentOrOutOfRange) {
  const std::vector<std::string> required = {"/camera", "/camera/fx",     "/camera/width",
                                             "/card",   "/card/pattern",  "/card/width_mm",
                                             "/views",  "/views/0/image", "/dish/rim_height_mm"};
  for (const std::string& key : required) {
    SpoiledCapture spoiled(capture("meals/m01"));
    const nlohmann::json::json_pointer pointer(key);
    auto& parent = spoiled.document.at(pointer.parent_pointer());
    parent.erase(pointer.back());
    spoiled.store();
    expect_error(spoiled.measure(), {"capture.json", pointer.back()});
  }
  const std::vector<std::pair<std::string, double>> wrong = {
      {"/camera/fx", 0.0},          {"/camera/fy", 0.0},         {"/camera/fx", -1388.0},
      {"/camera/width", 0},         {"/card/width_mm", 0.0},     {"/card/height_mm", -54.0},
      {"/card/thickness_mm", -1.0}, {"/dish/rim_height_mm", -1}, {"/dish/bottom_height_mm", 900.0}};
  for (const auto& [key, value] : wrong) {
    SpoiledCapture spoiled(capture("meals/m01"));
    const nlohmann::json::json_pointer pointer(key);
    spoiled.document.at(pointer) = value;
    spoiled.store();
    expect_error(spoiled.measure(), {"capture.json", pointer.back()});
  }
  SpoiledCapture spoiled(capture("meals/m01"));
  std::string text = spoiled.document.dump();
  text.replace(text.find("1388.4"), 6, "NaN");
  write_text(spoiled.file("capture.json"), text);
  expect_error(spoiled.measure(), {"capture.json"});
}

TEST_F(BadInput, UnknownKeysAreIgnored) {
  SpoiledCapture extended(capture("meals/m01"));
  extended.document["notes"] = "by hand";
  extended.document["camera"]["serial"] = 12;
  extended.store();
  EXPECT_EQ(extended.measure().status, 0);
}

TEST_F(BadInput, NoLabel) {
  SpoiledCapture spoiled(capture("meals/m01"));
  repaint(spoiled, "labels_1.png", [](cv::Mat& labels) { labels.setTo(0); });
  expect_refusal(spoiled.measure(), {"no_dish_label"});
  repaint(spoiled, "labels_0.png", [](cv::Mat& labels) { labels.setTo(1, (labels > 1) & (labels < 200)); });
  expect_refusal(spoiled.measure(), {"no_food_label"});
  spoiled.document["views"][0].erase("labels");
  spoiled.store();
  expect_error(spoiled.measure(), {"capture.json", "labels"});
}

TEST_F(BadInput, ACardThatIsNotInThePicture) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const SpoiledCapture spoiled(capture("meals/m01"));
    repaint(spoiled, "card.png", [&](cv::Mat& pattern) {
      cv::Mat noise(pattern.rows / 20, pattern.cols / 20, CV_8UC1);
      cv::RNG(seed).fill(noise, cv::RNG::UNIFORM, 0, 256);
      cv::resize(noise, pattern, pattern.size(), 0, 0, cv::INTER_CUBIC);
    });
    expect_refusal(spoiled.measure(), {"card_not_found"});
  }
  const SpoiledCapture plain(capture("meals/m01"));
  repaint(plain, "card.png", [](cv::Mat& pattern) { pattern.setTo(128); });
  expect_refusal(plain.measure(), {"card_not_found"});
}

TEST_F(BadInput, IdenticalViews) {
  const SpoiledCapture spoiled(capture("meals/m01"));
  expect_refusal(spoiled.measure({"--pair", "0,0"}), {"views_identical"});
  for (const std::string name : {"view_", "labels_"}) {
    const std::string type = name == "view_" ? ".jpg" : ".png";
    fs::copy_file(spoiled.file(name + "0" + type), spoiled.file(name + "1" + type),
                  fs::copy_options::overwrite_existing);
  }
  expect_refusal(spoiled.measure({"--pair", "0,1"}), {"views_identical"});
}

// The same scene saved again at another quality, under another name.
TEST_F(BadInput, IdenticalViewsCompressedAnew) {
  const SpoiledCapture spoiled(capture("meals/m01"));
  const cv::Mat picture = cv::imread(spoiled.file("view_0.jpg").string());
  cv::imwrite(spoiled.file("view_1.jpg").string(), picture, {cv::IMWRITE_JPEG_QUALITY, 70});
  fs::copy_file(spoiled.file("labels_0.png"), spoiled.file("labels_1.png"),
                fs::copy_options::overwrite_existing);
  expect_refusal(spoiled.measure({"--pair", "0,1"}), {"views_identical", "views_too_close"});
}

// The card is the same in all captures, so that a motion by the card alone exists.
TEST_F(BadInput, ViewsOfDifferentDishes) {
  const std::vector<std::string> names = {"meals/m01",      "meals/m04",     "meals/m08",
                                          "meals/m11",      "angles/a01",    "plates/c1_dinner",
                                          "plates/c1_oval", "plates/c1_soup"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string& other = names[(i + 1) % names.size()];
    const SpoiledCapture spoiled(capture(names[i]));
    for (const std::string file : {"view_1.jpg", "labels_1.png"}) {
      fs::copy_file(capture(other) / file, spoiled.file(file), fs::copy_options::overwrite_existing);
    }
    const auto donor = nlohmann::json::parse(read_text(capture(other) / "capture.json"));
    SpoiledCapture mixed(spoiled.file(""));
    mixed.document["views"][1]["camera"] = donor.at("camera");
    mixed.store();
    expect_refusal(
        mixed.measure({"--pair", "0,1"}),
        {"too_few_matches", "pose_not_found", "card_not_found", "pose_contradicts_card",
         "labels_inconsistent", "scale_not_found", "table_not_found", "too_little_depth",
         "views_too_far_apart", "rim_not_found", "disparity_range_too_large", "rectification_failed"});
  }
}

TEST_F(BadInput, LabelsExchanged) {
  for (const std::string name : {"meals/m01", "meals/m08", "meals/m11", "angles/a01", "plates/c1_soup"}) {
    SpoiledCapture spoiled(capture(name));
    auto& views = spoiled.document["views"];
    std::swap(views[0]["labels"], views[1]["labels"]);
    spoiled.store();
    expect_refusal(spoiled.measure({"--pair", "0,1"}),
                   {"labels_inconsistent", "card_not_found", "dish_unknown"});
  }
}

TEST_F(BadInput, BlackAndBurntOut) {
  for (const std::string name : {"view_0.jpg", "view_1.jpg"}) {
    const SpoiledCapture black(capture("meals/m01"));
    repaint(black, name, [](cv::Mat& picture) { picture.setTo(0); });
    expect_refusal(black.measure(), {"frame_too_dark"});
    const SpoiledCapture burnt(capture("meals/m01"));
    repaint(burnt, name, [](cv::Mat& picture) { picture.setTo(cv::Scalar(255, 255, 255)); });
    expect_refusal(burnt.measure(), {"frame_too_bright"});
    const SpoiledCapture gray(capture("meals/m01"));
    repaint(gray, name, [](cv::Mat& picture) { picture.setTo(cv::Scalar(128, 128, 128)); });
    expect_refusal(gray.measure(), {"too_few_features"});
  }
}

// A dish that stands there but is not the one described.
TEST_F(BadInput, AnotherDishThanDescribed) {
  SpoiledCapture spoiled(capture("meals/m01"));
  spoiled.document["dish"]["outer_size_mm"] = {200.0, 200.0};
  spoiled.document["dish"].erase("profile");
  spoiled.store();
  expect_refusal(spoiled.measure(), {"dish_unknown"});
}

}  // namespace
}  // namespace traygauge
