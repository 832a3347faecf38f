// The station's loop under fault scripts: every kind on every device, and hundreds drawn at random. Whatever
// happens, each press has at most one result and no volume is wrong, the lamp agrees with the result, the
// loop ends within bounded time, and scans are measured again once the faults are over.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "tests/firmware/station/station_rig.hpp"
#include "tests/simulator/devices/random_faults.hpp"

namespace traygauge {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kTrays = 40;
// Large enough that a few rows of another view change the mean of a block.
constexpr SyntheticCapture kTray{.width = 48, .height = 40};

struct Outcome {
  int measured = 0;
  int failed = 0;
};

class ScriptedStation {
 public:
  ScriptedStation(const std::string& script, bool has_arm)
      : rig_(std::vector(kTrays, kTray), has_arm), script_(script) {
    rig_.apply(read_fault_file(FaultFile(script).path()));
    rig_.params.max_retries = 50;
    rig_.params.max_scans = kTrays;
    rig_.sink.on_delivery = [this] { over_at_delivery_.push_back(rig_.faults_are_over()); };
    rig_.run();
  }
  StationRig& rig() { return rig_; }

  Outcome check() {
    SCOPED_TRACE(script_);
    Outcome outcome;
    std::size_t results = 0;
    int scans_since_over = 0;
    std::uint64_t last_scan = 0;
    for (const std::string& line : rig_.sink.lines) {
      if (line.starts_with("fault") || line.starts_with("recovery")) continue;
      const Scan scan = parse(line);
      EXPECT_EQ(scan.number, ++last_scan);
      const bool is_measured = scan.outcome == "measured";
      ++(is_measured ? outcome.measured : outcome.failed);
      EXPECT_TRUE(!is_measured || is_volume_of_a_tray(scan.volume)) << line;
      // The first scan after the last fault may still suffer from it: the arm has lost steps.
      if (results > 0 && over_at_delivery_[results - 1]) ++scans_since_over;
      EXPECT_TRUE(is_measured || scans_since_over <= 1) << line;
      ++results;
    }
    EXPECT_EQ(results, rig_.station->totals().scans);
    EXPECT_EQ(rig_.station->state(), StationState::finished);
    EXPECT_LT(rig_.clock.now(), Instant(5h));
    return outcome;
  }

 private:
  struct Scan {
    std::uint64_t number = 0;
    std::string outcome;
    int volume = 0;
  };
  static Scan parse(const std::string& line) {
    Scan scan;
    std::istringstream words(line);
    std::string status;
    words >> scan.number >> scan.outcome >> status >> scan.volume;
    return scan;
  }
  static bool is_volume_of_a_tray(int volume) {
    for (std::size_t i = 0; i < kTrays; ++i) {
      if (volume == 10 * SyntheticCaptures::gray_of(i, 0) + SyntheticCaptures::gray_of(i, 1)) return true;
    }
    return false;
  }

  StationRig rig_;
  std::string script_;
  std::vector<bool> over_at_delivery_;
};

std::vector<SimulatedDevice> devices_of(bool has_arm) {
  std::vector<SimulatedDevice> devices = all_simulated_devices();
  if (!has_arm) std::erase(devices, SimulatedDevice::arm);
  return devices;
}

TEST(StationScripts, SurviveEveryKindOnEveryDevice) {
  for (const bool has_arm : {true, false}) {
    for (const SimulatedDevice device : devices_of(has_arm)) {
      for (const FaultKind kind : kinds_of(device)) {
        for (const int after_calls : {0, 1, 2, 3, 4, 5, 9}) {
          for (const char* times : {"1", "2", "3", "7", "\"forever\""}) {
            std::ostringstream script;
            script << fault_text(device, kind, usual_amount(kind)) << "after_calls = " << after_calls
                   << "\ntimes = " << times << "\n";
            const Outcome outcome = ScriptedStation(script.str(), has_arm).check();
            EXPECT_TRUE(outcome.measured >= 30 || *times == '"') << script.str();
          }
        }
      }
    }
  }
}

TEST(StationScripts, SurviveRandomFaults) {
  std::map<bool, Outcome> sums;
  for (const bool has_arm : {true, false}) {
    for (unsigned seed = 0; seed < 500; ++seed) {
      SCOPED_TRACE(testing::Message() << "seed " << seed);
      const Outcome outcome =
          ScriptedStation(random_fault_script(seed, devices_of(has_arm)), has_arm).check();
      sums[has_arm].measured += outcome.measured;
      sums[has_arm].failed += outcome.failed;
    }
    EXPECT_GT(sums[has_arm].failed, 300);  // both happened, often
    EXPECT_GT(sums[has_arm].measured, 10'000);
  }
}

TEST(StationScripts, GiveTheSameHistoryEveryTime) {
  const auto history_of = [](unsigned seed) {
    ScriptedStation station(random_fault_script(seed, devices_of(true)), true);
    StationRig& rig = station.rig();
    return std::tuple(rig.lamp.history(), rig.sink.lines, rig.sink.durations, rig.clock.now());
  };
  for (unsigned seed = 0; seed < 50; ++seed) EXPECT_EQ(history_of(seed), history_of(seed)) << seed;
  EXPECT_NE(history_of(1), history_of(2));
}

// What a person is told, fault by fault: the result and what the lamp shows with it.
TEST(StationScripts, LampAndResultSayWhatHappened) {
  using enum Signal;
  struct Case {
    SimulatedDevice device;
    FaultKind kind;
    double amount;
    const char* times;
    const char* result;
    Signal signal;
  };
  using enum SimulatedDevice;
  const Case cases[] = {
      {camera, FaultKind::off, 0.0, "1", "1 device_failed simulated camera device_gone", fault},
      {camera, FaultKind::stale, 0.0, "6", "1 device_failed simulated camera stale_frame", try_again},
      {camera, FaultKind::late, 3000.0, "6", "1 device_failed simulated camera timed_out", fault},
      {camera, FaultKind::torn, 0.0, "6", "1 device_failed simulated camera torn_frame", try_again},
      {camera, FaultKind::stuck, 0.0, "2", "1 not_measurable views_identical", try_again},
      {camera, FaultKind::garbage, 0.0, "6", "1 not_measurable card_not_found", try_again},
      {camera, FaultKind::wrong_size, 0.5, "6", "1 not_measurable frame_size_mismatch", try_again},
      {camera, FaultKind::mixed, -0.5, "1", "1 measured ok", done},
      {arm, FaultKind::stuck, 0.0, "1", "1 not_measurable views_identical", try_again},
      {arm, FaultKind::silent_stall, 0.0, "1", "1 not_measurable views_identical", try_again},
      {arm, FaultKind::stall, 0.0, "1", "1 device_failed simulated arm stalled", fault},
      {arm, FaultKind::off, 0.0, "1", "1 device_failed simulated arm device_gone", fault},
      {arm, FaultKind::slow, 40.0, "1", "1 device_failed simulated arm timed_out", fault},
  };
  for (const Case& told : cases) {
    // After the start and the first view; the arm: after the start's move home.
    const int camera_calls = told.kind == FaultKind::off ? 3 : 2;
    const int arm_calls = told.kind == FaultKind::off ? 4 : told.kind == FaultKind::stall ? 2 : 1;
    std::ostringstream script;
    script << fault_text(told.device, told.kind, told.amount)
           << "after_calls = " << (told.device == camera ? camera_calls : arm_calls)
           << "\ntimes = " << told.times << "\n";
    ScriptedStation station(script.str(), true);
    SCOPED_TRACE(script.str());
    const auto& lines = station.rig().sink.lines;
    ASSERT_FALSE(lines.empty());
    EXPECT_TRUE(lines[0].starts_with(told.result)) << lines[0];
    const auto signals = station.rig().signals();
    const auto first = std::find_if(signals.begin(), signals.end(), [](Signal signal) {
      return signal == done || signal == try_again || signal == fault;
    });
    ASSERT_NE(first, signals.end());
    EXPECT_EQ(*first, told.signal);
  }
}

TEST(StationScripts, ABouncingButtonIsOnePressEvenByHand) {
  StationRig rig(3, false);
  rig.apply(read_fault_file(
      FaultFile(fault_text(SimulatedDevice::button, FaultKind::bounce, 60.0) + "times = \"forever\"\n")
          .path()));
  EXPECT_TRUE(rig.run().all_worked());
  EXPECT_EQ(rig.station->totals().scans, 3U);
}

}  // namespace
}  // namespace traygauge
