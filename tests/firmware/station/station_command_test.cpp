// The whole station on recorded captures, with the real measurement.
#include "firmware/station/station_command.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "firmware/base/exit_status.hpp"
#include "firmware/command/program.hpp"
#include "firmware/measure/capture_session.hpp"
#include "firmware/station/recorded_captures.hpp"
#include "firmware/station/site_scene.hpp"
#include "simulator/capture/input_error.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class StationCommandRun : public testing::Test {
 protected:
  int play(const fs::path& folder) {
    command_.devices = "simulator:" + folder.string();
    out_.str("");
    return run_station(command_, open_recorded_captures, stop_, out_, log_);
  }
  std::vector<json> documents() const {
    std::vector<json> documents;
    std::istringstream lines(out_.str());
    for (std::string line; std::getline(lines, line);) documents.push_back(json::parse(line));
    return documents;
  }

  StationCommand command_;
  std::atomic<bool> stop_ = false;
  std::ostringstream out_;
  std::ostringstream log_;
};

class StationCommandOnCaptures : public StationCommandRun {
 protected:
  void SetUp() override {
    const char* const captures = std::getenv("TRAYGAUGE_CAPTURES");
    if (captures == nullptr || !fs::is_directory(captures)) GTEST_SKIP() << "no captures";
    captures_ = captures;
  }

  fs::path captures_;
};

const fs::path kDemo = TRAYGAUGE_SOURCE_DIR "/simulator/demo";

// What a scan says of each item, and what the measurement of the same files says, in bits.
void expect_same_items(const json& scan, const Measurement& measurement) {
  ASSERT_EQ(scan["items"].size(), measurement.items.size()) << scan["message"];
  for (std::size_t i = 0; i < measurement.items.size(); ++i) {
    const ItemResult& item = measurement.items[i];
    EXPECT_EQ(scan["items"][i]["label"], item.label);
    EXPECT_EQ(scan["items"][i]["dish"], item.dish);
    EXPECT_EQ(scan["items"][i]["status"], name(item.status));
    if (item.status != StatusCode::ok) continue;
    EXPECT_EQ(scan["items"][i]["volume_ml"], item.volume_ml);
  }
}

// A loose bound: what is tested is that each result belongs to its tray, not how good it is.
void expect_volumes(const json& document, const json& truth) {
  ASSERT_FALSE(document["items"].empty());
  for (const json& item : document["items"]) {
    for (const json& known : truth["items"]) {
      if (known["label"] != item["label"] || item["volume_ml"].is_null()) continue;
      const double ratio = item["volume_ml"].get<double>() / known["volume_ml"].get<double>();
      EXPECT_LT(std::abs(std::log(ratio)), std::log(1.5)) << document["tray"] << " " << item;
    }
  }
}

TEST_F(StationCommandOnCaptures, PlaysAFolderOfCapturesInOrderAndMeasuresEach) {
  command_.json = true;
  const int status = play(captures_ / "plates");
  const auto scans = documents();
  std::vector<std::string> trays;
  bool all_measured = true;
  for (const json& scan : scans) {
    trays.push_back(scan["tray"]);
    all_measured = all_measured && (scan["status"] == "ok" || scan["status"] == "partial");
    std::ifstream file(captures_ / "plates" / trays.back() / "truth.json");
    expect_volumes(scan, json::parse(file));
  }
  EXPECT_EQ(trays, (std::vector<std::string>{"c1_dinner", "c1_oval", "c1_soup"}));
  EXPECT_TRUE(all_measured);
  EXPECT_EQ(status, all_measured ? kExitMeasured : kExitNotMeasurable);
  EXPECT_EQ(log_.str(), "");
}

TEST_F(StationCommandOnCaptures, TheSameTrayTwiceGivesTheSameBits) {
  command_.json = true;
  command_.scans = 2;
  play(captures_ / "plates" / "c1_dinner");
  const auto scans = documents();
  ASSERT_EQ(scans.size(), 2U);
  EXPECT_EQ(scans[0]["items"], scans[1]["items"]);
  EXPECT_EQ(scans[0]["relative_angle_deg"], scans[1]["relative_angle_deg"]);
  EXPECT_EQ(scans[1]["scan"], 2);
}

TEST_F(StationCommandOnCaptures, ByHandMeasuresWhatTheArmMeasures) {
  command_.json = true;
  play(captures_ / "plates" / "c1_dinner");
  const auto by_arm = documents();
  command_.by_hand = true;
  play(captures_ / "plates" / "c1_dinner");
  ASSERT_EQ(by_arm.size(), 1U);
  ASSERT_EQ(documents().size(), 1U);
  EXPECT_EQ(documents()[0]["items"], by_arm[0]["items"]);
}

TEST_F(StationCommandOnCaptures, ADamagedPictureSpoilsItsScanOnly) {
  const fs::path root = fs::path(testing::TempDir()) / ("station_command_" + std::to_string(std::rand()));
  fs::copy(captures_ / "plates", root, fs::copy_options::recursive);
  std::ofstream(root / "c1_dinner" / "view_1.jpg", std::ios::trunc) << "no picture";
  EXPECT_EQ(play(root), kExitNotMeasurable);
  fs::remove_all(root);
  std::istringstream lines(out_.str());
  std::string first;
  std::string second;
  std::getline(lines, first);
  std::getline(lines, second);
  EXPECT_NE(first.find("view_1.jpg"), std::string::npos) << first;
  EXPECT_NE(second.find("c1_oval"), std::string::npos) << second;
  EXPECT_NE(second.find(" ml"), std::string::npos) << second;
}

TEST_F(StationCommandRun, FindsTheFoodOfTraysThatNobodyOutlined) {
  command_.json = true;
  command_.scans = 3;
  command_.labels.source = "auto";
  EXPECT_EQ(play(kDemo), kExitMeasured) << out_.str();
  const auto scans = documents();
  ASSERT_EQ(scans.size(), 3U);
  for (const json& scan : scans) {
    const Capture capture = read_capture(kDemo / scan["tray"].get<std::string>());
    CaptureSession session(capture, {0, 1}, capture.dishes, {}, LabelSource::automatic);
    expect_same_items(scan, session.measure(0));
    EXPECT_GT(scan["timing_ms"]["segmentation"], 0.0);
  }
  EXPECT_EQ(scans[0]["items"], scans[2]["items"]) << "the demo has two trays";
}

TEST_F(StationCommandRun, CapturesWithoutLabelsAreOutlinedByDefault) {
  const fs::path folder = fs::path(testing::TempDir()) / ("no_labels_" + std::to_string(std::rand()));
  fs::copy(kDemo / "mash_and_meatballs", folder);
  std::ifstream file(folder / "capture.json");
  json document = json::parse(file);
  for (json& view : document["views"]) view.erase("labels");
  std::ofstream(folder / "capture.json") << document;
  command_.json = true;
  EXPECT_EQ(play(folder), kExitMeasured) << out_.str();
  const auto found = documents();
  command_.labels.source = "given";
  EXPECT_THROW(play(folder), InputError);
  fs::remove_all(folder);
  command_.labels.source = "auto";
  play(kDemo / "mash_and_meatballs");
  EXPECT_EQ(found[0]["items"], documents()[0]["items"]);
}

TEST_F(StationCommandRun, CountsWhatTheMenuSays) {
  command_.json = true;
  command_.labels = {"auto", 1};
  EXPECT_EQ(play(kDemo / "mash_and_meatballs"), kExitMeasured);
  EXPECT_EQ(documents()[0]["items"].size(), 1U);
  command_.labels = {"", 1};
  EXPECT_THROW(play(kDemo / "mash_and_meatballs"), UsageError);
}

// Every dish is measured over its own planes in one go; items say on which they lie.
TEST_F(StationCommandOnCaptures, MeasuresAllDishesOfATrayInOneGo) {
  command_.json = true;
  command_.labels.source = "auto";
  for (const char* tray : {"t01", "t05"}) {
    SCOPED_TRACE(tray);
    play(captures_ / "trays" / tray);
    const Capture capture = read_capture(captures_ / "trays" / tray);
    ASSERT_GT(capture.dishes.size(), 1U);
    CaptureSession session(capture, capture.pairs.front(), capture.dishes, {}, LabelSource::automatic);
    const json scan = documents().at(0);
    expect_same_items(scan, session.measure(0));
    std::set<int> dishes;
    for (const json& item : scan["items"]) dishes.insert(item["dish"].get<int>());
    EXPECT_EQ(dishes.size(), capture.dishes.size()) << scan;
  }
}

TEST_F(StationCommandOnCaptures, DoesNothingWhenAskedToStop) {
  stop_ = true;
  EXPECT_EQ(play(captures_ / "plates"), kExitMeasured);
  EXPECT_EQ(out_.str(), "");
}

// A real station, of whose trays only lens, card and dishes are known.
TEST(SiteWithoutLabels, MeasuresWhatItFinds) {
  const Capture capture = read_capture(kDemo / "fish_and_potatoes");
  const std::array<LoadedView, 2> views = {load_view(capture.views[0]), load_view(capture.views[1])};
  StationFile station;
  station.lens.emplace();
  station.lens->camera = capture.views[0].camera;
  station.card = capture.card;
  SiteScene scene(station, capture.dishes);
  EstimatorMeasurer measurer(scene, scene.limits(), 0);
  CaptureSession session(capture, {0, 1}, capture.dishes, {}, LabelSource::automatic);
  for (int scan = 0; scan < 2; ++scan) {
    measurer.begin_scan({});
    EXPECT_TRUE(measurer.add_view({views[0].picture.frame(), 0, {}}).ok());
    // Looks for the card between the views, where drawing remembers the first.
    EXPECT_NEAR(measurer.turned_deg(views[1].picture.frame()).value_or(0.0), 15.2, 1.0);
    EXPECT_TRUE(measurer.add_view({views[1].picture.frame(), 0, {}}).ok());
    const Measurement& measured = measurer.measure();
    const Measurement& expected = session.measure(0);
    ASSERT_TRUE(measured.status.ok()) << name(measured.status.code());
    ASSERT_EQ(measured.items.size(), expected.items.size());
    for (std::size_t i = 0; i < measured.items.size(); ++i)
      EXPECT_EQ(measured.items[i].volume_ml, expected.items[i].volume_ml);
  }
  // A bare table: no card; said after the first view.
  const Picture bare(views[0].picture.size, PixelFormat::bgr8);
  measurer.begin_scan({});
  const Status refused = measurer.add_view({bare.frame(), 0, {}});
  EXPECT_FALSE(refused.ok());
  EXPECT_EQ(measurer.measure().status.code(), refused.code());
}

TEST(StationCommandUse, SaysWhatIsWrong) {
  std::ostringstream out;
  const std::atomic<bool> stop = false;
  StationCommand command;
  command.devices = "camera";
  EXPECT_THROW(run_station(command, open_recorded_captures, stop, out, out), UsageError);
  command.devices = "hardware:station.toml";
  command.labels.source = "auto";
  EXPECT_THROW(run_station(command, open_recorded_captures, stop, out, out), UsageError);
  command.labels = {};
  command.devices = "simulator:/nowhere/at/all";
  EXPECT_THROW(run_station(command, open_recorded_captures, stop, out, out), InputError);
  command.devices = "simulator:" TRAYGAUGE_SOURCE_DIR "/simulator/demo";
  command.faults = "/nowhere/faults.toml";
  EXPECT_THROW(run_station(command, open_recorded_captures, stop, out, out), InputError);
  command.faults = TRAYGAUGE_SOURCE_DIR "/simulator/demo/faults.toml";
  command.by_hand = true;
  EXPECT_THROW(run_station(command, open_recorded_captures, stop, out, out), UsageError);
  EXPECT_EQ(out.str(), "");
}

struct TypedCommand {
  StationCommand command;
  int status = 0;
  std::string error;
};

TypedCommand parse(const std::vector<const char*>& words) {
  TypedCommand typed;
  Program program("", "test");
  add_station_command(program, typed.command);
  std::ostringstream out;
  std::ostringstream error;
  typed.status = program.run(
      static_cast<int>(words.size()), words.data(), [] { return kExitMeasured; }, out, error);
  typed.error = error.str();
  return typed;
}

TEST(StationCommandUse, TakesItsOptions) {
  const auto [command, status, error] =
      parse({"program", "station", "--devices", "simulator:x", "--scans", "3", "--json", "--by-hand",
             "--second-view", "15", "--faults", "f.toml", "--labels", "auto", "--items", "4"});
  EXPECT_EQ(status, kExitMeasured) << error;
  EXPECT_EQ(command.labels.source, "auto");
  EXPECT_EQ(command.labels.items, 4);
  EXPECT_EQ(command.devices, "simulator:x");
  EXPECT_EQ(command.faults, "f.toml");
  EXPECT_EQ(command.scans, 3U);
  EXPECT_TRUE(command.json);
  EXPECT_TRUE(command.by_hand);
  EXPECT_EQ(command.second_view_deg, 15.0);
  EXPECT_EQ(parse({"program", "station", "--devices", "simulator:x", "--once"}).command.scans, 1U);
}

TEST(StationCommandUse, RefusesWhatItDoesNotTake) {
  const auto expect_refusal = [](std::vector<const char*> words, const std::string& beginning) {
    words.insert(words.begin(), {"program", "station"});
    const TypedCommand typed = parse(words);
    EXPECT_EQ(typed.status, kExitWrongUse);
    EXPECT_EQ(typed.error.find("test: " + beginning), 0U) << typed.error;
  };
  expect_refusal({}, "--devices is required");
  expect_refusal({"--devices", "simulator:x", "--items", "0"}, "--items: Value 0 not in range");
  expect_refusal({"--devices", "simulator:x", "--scans", "0"}, "--scans: Value 0 not in range");
  expect_refusal({"--devices", "simulator:x", "--scans", "2", "--once"}, "--scans excludes --once");
  expect_refusal({"--devices", "simulator:x", "--scans", "2", "--repeat"}, "--scans excludes --repeat");
}

}  // namespace
}  // namespace traygauge
