// Labels that nobody drew where something is in the way: what lies out of the picture, and cards that are
// covered or bent. And what a number of items on the menu changes.
#include <gtest/gtest.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "core/pipeline/measurement.hpp"
#include "tests/firmware/command_runner.hpp"
#include "tests/support/faulty_capture.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::FaultyCapture;

const fs::path kDemo = TRAYGAUGE_SOURCE_DIR "/simulator/demo";

json run_json(std::vector<std::string> arguments) {
  arguments.emplace_back("--json");
  const CommandResult result = run(arguments);
  EXPECT_LE(result.status, 1) << result.error;
  return json::parse(result.out, nullptr, false);
}

json segment(const fs::path& folder) {
  return run_json({"segment", folder.string()});
}

json measure(const fs::path& folder) {
  return run_json({"measure", folder.string(), "--labels", "auto"});
}

bool is_warned_of(const json& document, Warning warning) {
  const json& warnings = document.at("warnings");
  return std::any_of(warnings.begin(), warnings.end(),
                     [&](const json& entry) { return entry.at("code") == name(warning); });
}

enum class Side : std::uint8_t { left, right };

// The pictures without so many columns on one side, as a camera with a smaller sensor sees them.
void crop(const fs::path& folder, int view, Side side, int columns) {
  json document = json::parse(read_text(folder / "capture.json"));
  json& description = document["views"][static_cast<std::size_t>(view)];
  for (const char* key : {"image", "labels"}) {
    const std::string file = (folder / description[key].get<std::string>()).string();
    const cv::Mat picture = cv::imread(file, cv::IMREAD_UNCHANGED);
    const int first = side == Side::left ? columns : 0;
    cv::imwrite(file, picture.colRange(first, first + picture.cols - columns).clone());
  }
  json camera = description.value("camera", document["camera"]);
  camera["width"] = camera["width"].get<int>() - columns;
  if (side == Side::left) camera["cx"] = camera["cx"].get<double>() - columns;
  description["camera"] = camera;
  write_text(folder / "capture.json", document.dump());
}

// Columns between something of `label` and the picture's side; the picture's width where it is not there.
int columns_beside(const cv::Mat1b& labels, int label, Side side) {
  if (cv::countNonZero(labels == label) == 0) return labels.cols;
  const cv::Rect box = cv::boundingRect(labels == label);
  return side == Side::left ? box.x : labels.cols - box.x - box.width;
}

// Cuts `depth_px` of the outermost dish off both views, on the side where the card does not lie; its label.
int cut_off_a_dish(FaultyCapture& capture, int depth_px, fs::path& folder) {
  const cv::Mat1b& first = capture.view(0).labels;
  const Side side = columns_beside(first, 255, Side::left) < columns_beside(first, 255, Side::right)
                        ? Side::right
                        : Side::left;
  int outermost = 0;
  std::array<int, 2> columns{};
  for (const int label : {1, 201, 202, 203}) {
    if (outermost != 0 && columns_beside(first, label, side) >= columns_beside(first, outermost, side))
      continue;
    outermost = label;
  }
  for (int v = 0; v < 2; ++v)
    columns[static_cast<std::size_t>(v)] = columns_beside(capture.view(v).labels, outermost, side) + depth_px;
  folder = capture.store();
  for (int v = 0; v < 2; ++v) crop(folder, v, side, columns[static_cast<std::size_t>(v)]);
  return outermost;
}

TEST(DishCutOff, IsReportedAndNotMeasured) {
  FaultyCapture capture(kDemo / "mash_and_meatballs", {0, 1});
  fs::path folder;
  cut_off_a_dish(capture, 30, folder);
  const json found = segment(folder);
  EXPECT_EQ(found["status"], "dish_cut_off");
  ASSERT_EQ(found["dishes"].size(), 1U);
  EXPECT_EQ(found["dishes"][0]["status"], "dish_cut_off");
  EXPECT_EQ(measure(folder)["status"], "dish_cut_off");
}

TEST(DishCutOff, OfATrayLeavesTheOthers) {
  if (captures_folder().empty()) GTEST_SKIP() << "TRAYGAUGE_CAPTURES names no captures";
  FaultyCapture capture(captures_folder() / "trays/t01", {0, 1});
  fs::path folder;
  const int outermost = cut_off_a_dish(capture, 25, folder);
  const json found = segment(folder);
  EXPECT_EQ(found["status"], "ok") << found;
  for (const json& dish : found["dishes"])
    EXPECT_EQ(dish["status"], dish["label"] == outermost ? "dish_cut_off" : "ok") << dish;
  const json measured = measure(folder);
  EXPECT_TRUE(measured["status"] == "ok" || measured["status"] == "partial") << measured["message"];
  EXPECT_TRUE(is_warned_of(measured, Warning::dish_not_found));
  for (const json& item : measured["items"]) EXPECT_NE(item["dish"], outermost);
}

// Refused for the card's sake, or measured with a warning: what is not covered may still show where it lies.
void expect_doubt(const FaultyCapture& capture) {
  const json document = measure(capture.store());
  const std::string status = document["status"];
  std::printf("%s\n", status.c_str());
  if (status == "ok" || status == "partial") {
    EXPECT_TRUE(is_warned_of(document, Warning::card_partly_hidden));
  } else {
    EXPECT_TRUE(status == "card_hidden" || status == "card_not_found") << status;
  }
}

// What is left of a picture's colours: 1 all, 0 none.
void fade(test::FaultyView& view, double share) {
  cv::Mat gray;
  cv::cvtColor(view.picture, gray, cv::COLOR_BGR2GRAY);
  cv::cvtColor(gray, gray, cv::COLOR_GRAY2BGR);
  cv::Mat faded;
  cv::addWeighted(view.picture, share, gray, 1.0 - share, 0.0, faded);
  faded.copyTo(view.picture);
}

TEST(GreyPictures, HaveNoOutlinesAndAreMeasuredWhereTheyAreGiven) {
  for (const char* name : {"mash_and_meatballs", "fish_and_potatoes"}) {
    for (const double share : {0.0, 0.05}) {
      for (const std::vector<int>& views : {std::vector{1}, std::vector{0, 1}}) {
        SCOPED_TRACE(testing::Message() << name << ", " << share << ", views: " << views.size());
        FaultyCapture capture(kDemo / name, {0, 1});
        for (const int v : views) fade(capture.view(v), share);
        const fs::path folder = capture.store();
        EXPECT_EQ(measure(folder)["status"], "picture_without_colour");
        EXPECT_EQ(segment(folder)["status"], "picture_without_colour");
        if (views.size() == 2) {
          EXPECT_EQ(run_json({"measure", folder.string()})["status"], "ok");
        }
      }
    }
  }
}

TEST(HiddenCard, IsDoubted) {
  for (const double share : {0.2, 0.35, 0.5, 0.8, 1.0}) {
    SCOPED_TRACE(share);
    FaultyCapture capture(kDemo / "mash_and_meatballs", {0, 1});
    test::cover_card(capture.view(1), share);
    expect_doubt(capture);
  }
}

TEST(HiddenCard, CutOffByThePictureIsReported) {
  FaultyCapture capture(kDemo / "mash_and_meatballs", {0, 1});
  const cv::Mat1b labels = capture.view(0).labels;
  const cv::Rect card = cv::boundingRect(labels == 255);
  const fs::path folder = capture.store();
  crop(folder, 0, Side::left, card.x + card.width / 4);
  const json found = segment(folder);
  EXPECT_TRUE(found["status"] == "card_hidden" || found["status"] == "card_not_found") << found["status"];
}

TEST(BentCard, IsDoubted) {
  for (const double rise_px : {5.0, 10.0}) {
    SCOPED_TRACE(rise_px);
    FaultyCapture capture(kDemo / "mash_and_meatballs", {0, 1});
    test::bend_card(capture.view(1), rise_px);
    expect_doubt(capture);
  }
}

TEST(CardWithoutAFault, IsNotDoubted) {
  for (const char* name : {"mash_and_meatballs", "fish_and_potatoes"})
    EXPECT_FALSE(is_warned_of(measure(kDemo / name), Warning::card_partly_hidden)) << name;
}

// One less than there are is one by joining, one more is one by splitting or, where nothing separates, as
// many as without the hint.
TEST(NumberOfItems, IsMetWhereTheFoodAllowsIt) {
  for (const char* name : {"mash_and_meatballs", "fish_and_potatoes"}) {
    SCOPED_TRACE(name);
    const std::string folder = (kDemo / name).string();
    const int found = segment(folder)["items"];
    ASSERT_GE(found, 2);
    for (const int items : {1, found - 1, found, found + 1}) {
      if (items < 1) continue;
      const json document = run_json({"segment", folder, "--items", std::to_string(items)});
      const int hinted = document["items"];
      EXPECT_EQ(document["items_doubtful"], hinted != items) << items;
      if (items <= found) {
        EXPECT_EQ(hinted, items);
      } else {
        EXPECT_TRUE(hinted == items || hinted == found) << hinted << " of " << items;
      }
    }
  }
}

TEST(NumberOfItems, IsMeasuredAsHinted) {
  const std::string folder = (kDemo / "mash_and_meatballs").string();
  const json document = run_json({"measure", folder, "--labels", "auto", "--items", "1"});
  EXPECT_EQ(document["status"], "ok") << document["message"];
  EXPECT_EQ(document["items"].size(), 1U);
}

TEST(NumberOfItems, ThatIsNotMetIsWarnedOf) {
  const std::string folder = (kDemo / "mash_and_meatballs").string();
  EXPECT_FALSE(is_warned_of(measure(folder), Warning::items_doubtful));
  const json document = run_json({"measure", folder, "--labels", "auto", "--items", "40"});
  EXPECT_LT(document["items"].size(), 40U);
  EXPECT_TRUE(is_warned_of(document, Warning::items_doubtful));
}

TEST(NumberOfItems, NeedsLabelsThatAreFound) {
  const CommandResult result = run({"measure", (kDemo / "mash_and_meatballs").string(), "--items", "2"});
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.error.find("--items"), std::string::npos) << result.error;
  EXPECT_NE(result.error.find("--labels auto"), std::string::npos) << result.error;
}

}  // namespace
}  // namespace traygauge
