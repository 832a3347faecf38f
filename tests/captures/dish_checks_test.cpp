// A dish as a second ruler: captures of the demo in which it slid, or whose card is said to be of another
// size or to lie higher. With outlines that are given and that are found.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>
#include <set>
#include <string>

#include "core/labels/label_set.hpp"
#include "tests/firmware/command_runner.hpp"
#include "tests/support/capture_truth.hpp"
#include "tests/support/faulty_capture.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const fs::path kDemoCaptures = TRAYGAUGE_SOURCE_DIR "/simulator/demo";

class DishChecks : public ::testing::TestWithParam<const char*> {
 protected:
  static json measure(const fs::path& folder) {
    const CommandResult result = run({"measure", folder.string(), "--labels", GetParam(), "--json"});
    EXPECT_LE(result.status, 1) << result.error;
    return json::parse(result.out, nullptr, false);
  }
  // The capture with other values of its card.
  static json measure_with_card(const json& changes) {
    const test::FaultyCapture capture(kDemoCaptures / "fish_and_potatoes", {0, 1});
    const fs::path folder = capture.store();
    json document = json::parse(read_text(folder / "capture.json"));
    document["card"].update(changes);
    write_text(folder / "capture.json", document.dump());
    return measure(folder);
  }
  // The capture with another dish: its rim and what lies below it so much higher, and its bottom that much
  // further down.
  static json measure_with_dish(const fs::path& name, double higher_mm, double deeper_mm) {
    const test::FaultyCapture capture(name, {0, 1});
    const fs::path folder = capture.store();
    json document = json::parse(read_text(folder / "capture.json"));
    json& dish = document["dish"];
    const double rim_mm = dish["rim_height_mm"];
    const double depth_mm = rim_mm - dish["bottom_height_mm"].get<double>();
    const auto moved = [&](const json& height_mm) {
      return rim_mm + higher_mm - (rim_mm - height_mm.get<double>()) * (1.0 + deeper_mm / depth_mm);
    };
    for (json& point : dish["profile"]) point[1] = moved(point[1]);
    for (const char* const key : {"rim_height_mm", "bottom_height_mm"}) dish[key] = moved(dish[key]);
    write_text(folder / "capture.json", document.dump());
    return measure(folder);
  }
  static json measure_with_moved_item(cv::Point offset_px);
  static std::set<std::string> codes(const json& document) {
    std::set<std::string> codes = {document.at("status").get<std::string>()};
    for (const json& warning : document.at("warnings")) codes.insert(warning.at("code").get<std::string>());
    return codes;
  }
  static double value(const json& document, const std::string& check) {
    for (const json& entry : document.at("checks")) {
      if (entry.at("name") == check) return entry.at("value");
    }
    return std::nan("");
  }
};

using GivenDishChecks = DishChecks;

// What has these labels; what it leaves is filled with what lies beyond.
template <class Moves>
void slide(test::FaultyView& view, cv::Point offset_px, Moves&& moves) {
  const test::FaultyView still = {view.picture.clone(), view.labels.clone()};
  const cv::Rect frame(0, 0, still.labels.cols, still.labels.rows);
  const auto is_moved = [&](cv::Point at) { return frame.contains(at) && moves(still.labels(at)); };
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) {
      cv::Point from = cv::Point(x, y) - offset_px;
      if (!is_moved(from)) {
        from = {x, y};
        while (is_moved(from) && frame.contains(from - offset_px)) from -= offset_px;
      }
      view.picture(y, x) = still.picture(from);
      view.labels(y, x) = still.labels(from);
    }
  }
}

// Dish and food, over the table.
void slide_dish(test::FaultyView& view, cv::Point offset_px) {
  slide(view, offset_px, [](std::uint8_t label) { return label != kBackgroundLabel && label != kCardLabel; });
}

json DishChecks::measure_with_moved_item(cv::Point offset_px) {
  test::FaultyCapture capture(kDemoCaptures / "fish_and_potatoes", {0, 1});
  slide(capture.view(1), offset_px, [](std::uint8_t label) { return label == 2; });
  return measure(capture.store());
}

std::ptrdiff_t count_moved(const json& document) {
  return std::ranges::count_if(document.at("items"),
                               [](const json& item) { return item.at("status") == "item_moved"; });
}

TEST_P(DishChecks, PassWhereNothingIsWrong) {
  for (const char* name : {"fish_and_potatoes", "mash_and_meatballs"}) {
    const json document = measure(kDemoCaptures / name);
    EXPECT_EQ(document.at("status"), "ok");
    ASSERT_EQ(document.at("checks").size(), 6U + 3U * document.at("items").size());
    for (const json& check : document.at("checks")) {
      EXPECT_EQ(check.at("verdict"), "passed") << check;
      const double value = check.at("value");
      if (check.at("name") == "item_foot_mm") {
        EXPECT_GT(value, -check.at("limit").get<double>()) << check;
      } else {
        EXPECT_LT(std::abs(value), check.at("limit").get<double>()) << check;
        // A share that was counted has none.
        EXPECT_EQ(check.at("sigma").get<double>() > 0.0, check.at("name") != "item_unlike_percent") << check;
      }
    }
  }
}

// Pixels that are shifted alike are nearly a dish that slid. With found outlines it is measured in its own
// frame; where that does not work out, and with given ones, it is refused.
TEST_P(DishChecks, MeasureOrRefuseADishThatSlid) {
  constexpr double kTruthMl = 295.144;
  int measured = 0;
  for (const cv::Point offset_px : {cv::Point(9, 3), cv::Point(6, 0), cv::Point(-4, 12)}) {
    SCOPED_TRACE(::testing::Message() << offset_px.x << " " << offset_px.y);
    test::FaultyCapture capture(kDemoCaptures / "fish_and_potatoes", {0, 1});
    slide_dish(capture.view(1), offset_px);
    const json document = measure(capture.store());
    // Outlines that were given contradict each other before the dish is looked at as a ruler.
    const std::set<std::string> others = {"pose_contradicts_card", "labels_inconsistent"};
    EXPECT_TRUE(codes(document).contains("dish_moved") ||
                (GetParam() == std::string("given") && others.contains(document.at("status"))))
        << document;
    if (document.at("status") != "ok") continue;
    ++measured;
    EXPECT_GT(value(document, "own_motion_mm"), 1.0);
    double sum_ml = 0.0;
    for (const json& item : document.at("items")) sum_ml += item.at("volume_ml").get<double>();
    EXPECT_NEAR(sum_ml, kTruthMl, 0.1 * kTruthMl) << document;
  }
  EXPECT_EQ(measured > 0, GetParam() == std::string("auto"));
}

// By as little as hardly shows.
TEST_P(DishChecks, LeaveOutAnItemThatMoved) {
  const json document = measure_with_moved_item({3, 3});
  EXPECT_EQ(document.at("status"), "partial") << document;
  EXPECT_EQ(count_moved(document), 1) << document;
}

// Further than its points are sought at first. Where outlines are found, it may look like one with what it
// slid against.
TEST_P(GivenDishChecks, LeaveOutAnItemThatMovedFar) {
  const json document = measure_with_moved_item({20, -12});
  EXPECT_EQ(document.at("status"), "partial") << document;
  EXPECT_EQ(count_moved(document), 1) << document;
}

TEST_P(GivenDishChecks, TellOfACardOfAnotherSize) {
  for (const double scale : {0.98, 1.02}) {
    const json document = measure_with_card({{"width_mm", 85.60 * scale}, {"height_mm", 53.98 * scale}});
    EXPECT_TRUE(codes(document).contains("scale_disagrees")) << document;
    EXPECT_NEAR(value(document, "scale_percent"), 100.0 * (scale - 1.0), 0.7);
  }
}

// With found outlines a dish is sought at its described size and larger. What looks smaller may be a band of
// its decoration.
TEST_P(DishChecks, TellOfACardThatIsStatedTooLarge) {
  for (const double scale : {1.02, 1.03, 1.05}) {
    const json document = measure_with_card({{"width_mm", 85.60 * scale}, {"height_mm", 53.98 * scale}});
    EXPECT_TRUE(codes(document).contains("scale_disagrees") || document.at("status") != "ok") << document;
  }
}

// As after another mode of the sensor was chosen.
TEST_P(DishChecks, NameALensThatDoesNotFit) {
  for (const double scale : {0.90, 0.94, 1.06, 1.10}) {
    const test::FaultyCapture capture(kDemoCaptures / "fish_and_potatoes", {0, 1});
    const fs::path folder = capture.store();
    json document = json::parse(read_text(folder / "capture.json"));
    for (const char* const key : {"fx", "fy"}) {
      json& focal_px = document["camera"][key];
      focal_px = focal_px.get<double>() * scale;
    }
    write_text(folder / "capture.json", document.dump());
    const json measured = measure(folder);
    EXPECT_TRUE(codes(measured).contains("lens_does_not_fit")) << scale << ": " << measured;
    EXPECT_NEAR(value(measured, "focal_percent"), 100.0 * (1.0 / scale - 1.0), 2.6) << scale;
  }
}

// Its print lies at 0.8 mm.
TEST_P(DishChecks, TellOfACardThatLiesElsewhereThanSaid) {
  const json document = measure_with_card({{"thickness_mm", 4.3}});
  EXPECT_TRUE(codes(document).contains("card_lifted")) << document;
}

// The table around the card lies where it belongs, so it is the dish.
TEST_P(GivenDishChecks, TellOfADishThatIsHigherThanSaid) {
  const json document = measure_with_dish(kDemoCaptures / "fish_and_potatoes", -2.2, 0.0);
  EXPECT_TRUE(codes(document).contains("dish_differs")) << document;
  EXPECT_LT(std::abs(value(document, "table_height_mm")), 0.3) << document;
}

// Its rim is as described; its scratched glaze shows where the bottom lies.
TEST_P(DishChecks, TellOfADishThatIsDeeperOrShallowerThanSaid) {
  if (captures_folder().empty()) GTEST_SKIP() << "TRAYGAUGE_CAPTURES names no captures";
  const fs::path capture = captures_folder() / "meals/m08";
  EXPECT_LT(std::abs(value(measure_with_dish(capture, 0.0, 0.0), "glaze_height_mm")), 0.5);
  for (const double deeper_mm : {-3.0, 3.0}) {
    const json document = measure_with_dish(capture, 0.0, deeper_mm);
    EXPECT_TRUE(codes(document).contains("dish_differs")) << document;
    EXPECT_NEAR(value(document, "glaze_height_mm"), deeper_mm, 0.8) << document;
  }
}

// Three dishes stand on the tray, of which the description names two.
TEST(DishChecks, TellOfADishThatNobodyNamed) {
  if (captures_folder().empty()) GTEST_SKIP() << "TRAYGAUGE_CAPTURES names no captures";
  const test::FaultyCapture capture(captures_folder() / "trays/t01", {0, 1});
  const fs::path folder = capture.store();
  json document = json::parse(read_text(folder / "capture.json"));
  for (const bool is_named : {true, false}) {
    if (!is_named) {
      json& dishes = document["dishes"];
      dishes.erase(dishes.size() - 1);
      write_text(folder / "capture.json", document.dump());
    }
    const CommandResult result = run({"measure", folder.string(), "--labels", "auto", "--json"});
    EXPECT_EQ(result.out.find("unknown_object") == std::string::npos, is_named) << result.out;
  }
}

// Without a profile its bottom counts as flat up to the edge.
TEST_P(DishChecks, TellOfADishWithoutAProfile) {
  const test::FaultyCapture capture(kDemoCaptures / "fish_and_potatoes", {0, 1});
  const fs::path folder = capture.store();
  EXPECT_FALSE(codes(measure(folder)).contains("dish_shape_unknown"));
  json document = json::parse(read_text(folder / "capture.json"));
  document["dish"].erase("profile");
  write_text(folder / "capture.json", document.dump());
  const json measured = measure(folder);
  EXPECT_TRUE(codes(measured).contains("dish_shape_unknown")) << measured;
  for (const json& item : measured.at("items"))
    EXPECT_GT(item.at("sigma_ml").get<double>(), 0.1 * item.at("volume_ml").get<double>()) << measured;
}

// Spots over the first item, in one picture or at the same place of both.
json measure_behind_spots(bool in_both, const cv::Scalar& colour) {
  test::FaultyCapture capture(kDemoCaptures / "fish_and_potatoes", {0, 1});
  const cv::Rect box = cv::boundingRect(capture.view(0).labels == kFirstItemLabel);
  const cv::Point middle = (box.tl() + box.br()) / 2;
  const int radius_px = std::min(box.width, box.height) / 2;
  for (int v = 0; v < (in_both ? 2 : 1); ++v)
    cv::circle(capture.view(v).picture, middle, radius_px, colour, cv::FILLED, cv::LINE_AA);
  const CommandResult result = run({"measure", capture.store().string(), "--labels", "given", "--json"});
  EXPECT_LE(result.status, 1) << result.error;
  return json::parse(result.out, nullptr, false);
}

TEST_P(GivenDishChecks, TellOfAGlovedFingerOverFood) {
  const json document = measure_behind_spots(false, cv::Scalar(190, 120, 40));
  EXPECT_TRUE(codes(document).contains("pictures_differ")) << document;
}

TEST_P(GivenDishChecks, TellOfDirtOnTheLens) {
  const json document = measure_behind_spots(true, cv::Scalar(25, 28, 30));
  EXPECT_TRUE(codes(document).contains("lens_dirty")) << document;
}

INSTANTIATE_TEST_SUITE_P(Labels, GivenDishChecks, ::testing::Values("given"));
INSTANTIATE_TEST_SUITE_P(Labels, DishChecks, ::testing::Values("given", "auto"),
                         [](const auto& parameter) { return std::string(parameter.param); });

}  // namespace
}  // namespace traygauge
