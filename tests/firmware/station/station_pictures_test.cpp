// `traygauge station --faults` on the demo's pictures with the real measurement: whatever fails, no volume
// differs from the undisturbed one by more than its own uncertainty.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "firmware/base/exit_status.hpp"
#include "firmware/station/recorded_captures.hpp"
#include "firmware/station/station_command.hpp"
#include "tests/simulator/capture/small_demo.hpp"
#include "tests/simulator/devices/random_faults.hpp"

namespace traygauge {
namespace {

using nlohmann::json;

constexpr std::uint64_t kScans = 3;

struct Played {
  std::vector<json> scans;
  std::string text;
  std::string log;
  int exit_status = 0;
};

Played play(const std::filesystem::path& faults, bool by_hand = false, std::uint64_t scans = kScans) {
  static const SmallDemo demo;
  StationCommand command;
  command.devices = "simulator:" + demo.folder().string();
  command.faults = faults.string();
  command.scans = scans;
  command.json = true;
  command.by_hand = by_hand;
  const std::atomic<bool> stop = false;
  std::ostringstream out;
  std::ostringstream log;
  Played played;
  played.exit_status = run_station(command, open_recorded_captures, stop, out, log);
  played.text = out.str();
  played.log = log.str();
  std::istringstream lines(played.text);
  for (std::string line; std::getline(lines, line);) played.scans.push_back(json::parse(line));
  return played;
}

bool is_measured(const json& scan) {
  return scan["status"] == "ok" || scan["status"] == "partial";
}

class StationOnPictures : public testing::Test {
 protected:
  StationOnPictures() {
    const Played clean = play({});
    EXPECT_EQ(clean.exit_status, kExitMeasured);
    for (const json& scan : clean.scans) items_[scan["tray"]] = scan["items"];
    EXPECT_EQ(items_.size(), 2U);
  }

  // The number of measured scans.
  int check(const Played& played) {
    int measured = 0;
    for (const json& scan : played.scans) {
      if (!is_measured(scan)) {
        EXPECT_NE(scan["message"], "") << scan;
        continue;
      }
      ++measured;
      const json& clean = items_.at(scan["tray"]);
      EXPECT_EQ(scan["items"].size(), clean.size()) << scan;
      for (std::size_t i = 0; i < std::min(scan["items"].size(), clean.size()); ++i) {
        const json& item = scan["items"][i];
        EXPECT_EQ(item["label"], clean[i]["label"]);
        if (item["volume_ml"].is_null()) continue;
        EXPECT_NEAR(item["volume_ml"].get<double>(), clean[i]["volume_ml"].get<double>(),
                    clean[i]["sigma_ml"].get<double>())
            << scan;
      }
    }
    const bool all_measured = played.scans.size() == kScans && measured == kScans;
    EXPECT_EQ(played.exit_status, all_measured ? kExitMeasured : kExitNotMeasurable);
    return measured;
  }

  std::map<std::string, json> items_;
};

TEST_F(StationOnPictures, EveryKindOnEveryDeviceLeavesNoVolumeWrong) {
  for (const SimulatedDevice device : all_simulated_devices()) {
    const bool shows_in_pictures = device == SimulatedDevice::camera || device == SimulatedDevice::arm;
    for (const FaultKind kind : kinds_of(device)) {
      for (const auto& [after_calls, times] : {std::pair{1, 1}, {2, 1}, {2, 6}, {3, 6}}) {
        if (!shows_in_pictures && (after_calls != 2 || times != 1)) continue;
        std::ostringstream script;
        script << fault_text(device, kind, usual_amount(kind)) << "after_calls = " << after_calls
               << "\ntimes = " << times << "\n";
        SCOPED_TRACE(script.str());
        const Played played = play(FaultFile(script.str()).path());
        ASSERT_EQ(played.scans.size(), kScans);
        check(played);
        if (times == 1) {
          EXPECT_EQ(played.scans.back()["status"], "ok") << played.text;
        }
      }
    }
  }
}

// A tear anywhere in the picture, from above or from below, while the arm's move lies between the two parts.
TEST_F(StationOnPictures, RowsOfTwoViewsAreNeverMeasured) {
  for (const double share : {-0.95, -0.7, -0.55, -0.5, -0.45, -0.4, -0.3, -0.1, -0.03, 0.03, 0.1, 0.5, 0.9}) {
    for (const int after_calls : {2, 4}) {
      std::ostringstream script;
      script << fault_text(SimulatedDevice::camera, FaultKind::mixed, share)
             << "after_calls = " << after_calls << "\ntimes = \"forever\"\n";
      SCOPED_TRACE(script.str());
      EXPECT_EQ(check(play(FaultFile(script.str()).path())), static_cast<int>(kScans));
    }
  }
}

// The demo's arm angles are recorded: an arm that says another one is found out, and the scan taken again.
TEST_F(StationOnPictures, AWrongAngleIsMeasuredAgain) {
  const std::string script =
      fault_text(SimulatedDevice::arm, FaultKind::wrong_angle, 2.0) + "after_calls = 1\n";
  const Played played = play(FaultFile(script).path());
  ASSERT_EQ(check(played), static_cast<int>(kScans));
  EXPECT_TRUE(played.scans[0]["warnings"].empty());
  EXPECT_GT(played.scans[0]["duration_ms"], 1.5 * played.scans[1]["duration_ms"].get<double>());
}

TEST_F(StationOnPictures, AnArmThatNeverStandsWhereItSaysIsRefused) {
  const Played played =
      play(FaultFile(fault_text(SimulatedDevice::arm, FaultKind::wrong_angle, 2.0) + "times = \"forever\"\n")
               .path());
  EXPECT_EQ(check(played), 0);
  EXPECT_EQ(played.scans[0]["status"], "stalled");
  EXPECT_TRUE(played.scans[0]["items"].empty());
  EXPECT_NE(std::string(played.scans[0]["message"]).find("twice the pictures show another angle"),
            std::string::npos)
      << played.scans[0];
}

TEST(StationOnNoPictures, EndsAndSaysSoWhenNothingComesBack) {
  const Played gone = play(
      FaultFile(fault_text(SimulatedDevice::camera, FaultKind::off, 0.0) + "times = \"forever\"\n").path());
  EXPECT_EQ(gone.exit_status, kExitNotMeasurable);
  EXPECT_NE(gone.log.find("simulated camera: The device has disappeared"), std::string::npos) << gone.log;
  EXPECT_NE(gone.log.find("Ended after 0 of 3 scans: a device did not come back."), std::string::npos);
  const Played lost = play(
      FaultFile(fault_text(SimulatedDevice::button, FaultKind::stuck, 0.0) + "times = \"forever\"\n").path());
  EXPECT_EQ(lost.exit_status, kExitNotMeasurable);
  EXPECT_EQ(lost.log, "Ended after 0 of 3 scans: no press came through any more.\n");
}

TEST_F(StationOnPictures, RandomScriptsLeaveNoVolumeWrong) {
  int measured = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const bool by_hand = seed % 4 == 0;
    std::vector<SimulatedDevice> devices = all_simulated_devices();
    if (by_hand) std::erase(devices, SimulatedDevice::arm);
    measured += check(play(FaultFile(random_fault_script(seed, devices)).path(), by_hand));
  }
  EXPECT_GT(measured, 30);
  EXPECT_LT(measured, 60);
}

// As its comments say; simulator/README.md shows it to newcomers.
TEST_F(StationOnPictures, TheDemosScriptTellsItsStory) {
  const Played played = play(TRAYGAUGE_SOURCE_DIR "/simulator/demo/faults.toml", false, 7);
  std::vector<std::string> statuses;
  for (const json& scan : played.scans) statuses.push_back(scan["status"]);
  EXPECT_EQ(statuses,
            (std::vector<std::string>{"ok", "stalled", "ok", "card_not_found", "ok", "device_gone", "ok"}));
  EXPECT_TRUE(played.scans.at(4)["warnings"].empty());
}

TEST_F(StationOnPictures, TheSameScriptGivesTheSameHistory) {
  const auto history = [](const Played& played) {
    std::vector<json> scans = played.scans;
    for (json& scan : scans) scan.erase("timing_ms");
    return std::pair(scans, played.log);
  };
  const FaultFile script(random_fault_script(3, all_simulated_devices()));
  EXPECT_EQ(history(play(script.path())), history(play(script.path())));
}

}  // namespace
}  // namespace traygauge
