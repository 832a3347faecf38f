// The whole station on recorded captures, with the real measurement.
#include "firmware/station/station_command.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "firmware/base/exit_status.hpp"
#include "firmware/station/recorded_captures.hpp"
#include "simulator/capture/input_error.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class StationCommandOnCaptures : public testing::Test {
 protected:
  void SetUp() override {
    const char* const captures = std::getenv("TRAYGAUGE_CAPTURES");
    if (captures == nullptr || !fs::is_directory(captures)) GTEST_SKIP() << "no captures";
    captures_ = captures;
  }
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

  fs::path captures_;
  StationCommand command_;
  std::atomic<bool> stop_ = false;
  std::ostringstream out_;
  std::ostringstream log_;
};

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

// Measured as one dish, the items of the others would get volumes above the wrong plane.
TEST_F(StationCommandOnCaptures, ProfilePaperRefusesATrayWithSeveralDishes) {
  command_.profile = "paper";
  try {
    play(captures_ / "trays" / "t01");
    FAIL() << "was played: " << out_.str();
  } catch (const InputError& problem) {
    EXPECT_EQ(problem.problem().key, "dishes");
  }
  EXPECT_TRUE(out_.str().empty());
}

TEST_F(StationCommandOnCaptures, DoesNothingWhenAskedToStop) {
  stop_ = true;
  EXPECT_EQ(play(captures_ / "plates"), kExitMeasured);
  EXPECT_EQ(out_.str(), "");
}

TEST(StationCommandUse, SaysWhatIsWrong) {
  std::ostringstream out;
  const std::atomic<bool> stop = false;
  StationCommand command;
  command.devices = "camera";
  EXPECT_THROW(run_station(command, open_recorded_captures, stop, out, out), UsageError);
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

TEST(StationCommandUse, TakesItsOptions) {
  const auto parse = [](std::vector<std::string> words) {
    CLI::App app;
    StationCommand command;
    add_station_command(app, command);
    std::reverse(words.begin(), words.end());
    app.parse(words);
    return command;
  };
  const StationCommand command = parse({"station", "--devices", "simulator:x", "--scans", "3", "--json",
                                        "--by-hand", "--second-view", "15", "--faults", "f.toml"});
  EXPECT_EQ(command.devices, "simulator:x");
  EXPECT_EQ(command.faults, "f.toml");
  EXPECT_EQ(command.scans, 3U);
  EXPECT_TRUE(command.json);
  EXPECT_TRUE(command.by_hand);
  EXPECT_EQ(command.second_view_deg, 15.0);
  EXPECT_EQ(parse({"station", "--devices", "simulator:x", "--once"}).scans, 1U);
  EXPECT_THROW(parse({"station"}), CLI::ParseError);
  EXPECT_THROW(parse({"station", "--devices", "simulator:x", "--scans", "0"}), CLI::ParseError);
  EXPECT_THROW(parse({"station", "--devices", "simulator:x", "--scans", "2", "--once"}), CLI::ParseError);
}

}  // namespace
}  // namespace traygauge
