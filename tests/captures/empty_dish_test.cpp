// A dish that nobody put food on: no item is a result, if both views show the bare dish.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "core/labels/label_regions.hpp"
#include "tests/firmware/command_runner.hpp"
#include "tests/support/empty_dish.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

test::EmptyDishScene plain_dish(const std::string& style) {
  test::EmptyDishScene scene;
  scene.dish = test::read_dish_model(style);
  scene.glaze_contrast = 0.0;
  return scene;
}

CommandResult measure(const fs::path& folder, const char* labels) {
  return run(
      {"measure", folder.string(), "--labels", labels, "--config", TRAYGAUGE_SOURCE_DIR "/config", "--json"});
}

// A dark disk in the middle of the dish, as something looks that lies there in one picture alone.
void paint_disk(const fs::path& folder, int view, int radius_px) {
  const std::string name = std::to_string(view);
  const cv::Mat labels = cv::imread((folder / ("labels_" + name + ".png")).string(), cv::IMREAD_UNCHANGED);
  const cv::Rect dish = cv::boundingRect(labels == kDishLabel);
  const fs::path file =
      json::parse(read_text(folder / "capture.json"))["views"][static_cast<std::size_t>(view)]["image"]
          .get<std::string>();
  cv::Mat picture = cv::imread((folder / file).string(), cv::IMREAD_COLOR);
  cv::circle(picture, (dish.tl() + dish.br()) / 2, radius_px, {40, 60, 120}, cv::FILLED);
  cv::imwrite((folder / file).string(), picture);
}

TEST(EmptyDish, IsMeasuredAsNothingAndSaysSo) {
  for (const char* style : {"dinner", "soup", "oval"}) {
    SCOPED_TRACE(style);
    const test::EmptyDishCapture capture(plain_dish(style));
    const CommandResult result = measure(capture.folder(), "auto");
    ASSERT_EQ(result.status, 0) << result.out << result.error;
    const json document = json::parse(result.out);
    EXPECT_EQ(document["status"], "ok");
    EXPECT_TRUE(document["items"].empty());
    const json& warnings = document["warnings"];
    const bool says_so = std::any_of(warnings.begin(), warnings.end(), [](const json& warning) {
      return warning["code"] == "dish_empty" && warning["label"] == kDishLabel;
    });
    EXPECT_TRUE(says_so) << warnings;
  }
}

TEST(EmptyDish, IsNotOneThatHoldsSomethingInOnePicture) {
  for (const int view : {0, 1}) {
    SCOPED_TRACE(view);
    const test::EmptyDishCapture capture(plain_dish("dinner"));
    paint_disk(capture.folder(), view, 60);
    const CommandResult result = measure(capture.folder(), "auto");
    EXPECT_EQ(result.status, 1) << result.out << result.error;
    EXPECT_EQ(json::parse(result.out)["status"], "no_food_label");
  }
}

TEST(EmptyDish, ContradictsANumberOfItems) {
  const test::EmptyDishCapture capture(plain_dish("dinner"));
  const CommandResult result = run({"measure", capture.folder().string(), "--labels", "auto", "--items", "2",
                                    "--config", TRAYGAUGE_SOURCE_DIR "/config", "--json"});
  EXPECT_EQ(result.status, 1) << result.out << result.error;
  EXPECT_EQ(json::parse(result.out)["status"], "no_food_label");
}

// Who outlines a dish by hand means to outline its food as well.
TEST(EmptyDish, IsRefusedWhereOutlinesWereGiven) {
  const test::EmptyDishCapture capture(plain_dish("dinner"));
  const CommandResult result = measure(capture.folder(), "given");
  EXPECT_EQ(result.status, 1) << result.out << result.error;
  EXPECT_EQ(json::parse(result.out)["status"], "no_food_label");
}

}  // namespace
}  // namespace traygauge
