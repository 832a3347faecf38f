// The station's table of states, held against what the loop does under random events: presses, held buttons,
// devices that fail, arms that stand elsewhere, results that find no room, and an end at any time.
#include "firmware/station/station_state.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <random>
#include <set>
#include <string>
#include <utility>

#include "tests/firmware/station/station_rig.hpp"
#include "tests/simulator/devices/random_faults.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

using namespace std::chrono_literals;
using Seen = std::set<std::pair<StationState, StationState>>;

// Small and plain, so that thousands of runs take seconds.
constexpr SyntheticCapture kSmallTray{.width = 48, .height = 40};
constexpr std::size_t kTraysInARun = 6;

class RandomRun {
 public:
  RandomRun(std::uint64_t seed, bool has_arm)
      : random_(seed), rig_(std::vector(kTraysInARun, kSmallTray), has_arm) {
    std::vector<SimulatedDevice> devices = all_simulated_devices();
    if (!has_arm) std::erase(devices, SimulatedDevice::arm);
    script_ = random_fault_script(static_cast<unsigned>(random_() >> 33U), devices);
    if (!one_in(4)) rig_.apply(read_fault_file(FaultFile(script_).path()));
    rig_.params.max_retries = 20;
    rig_.params.max_scans = kTraysInARun;
    rig_.measurer.disagreements = one_in(3) ? 1 : 0;
    if (one_in(6)) rig_.measurer.first_view_status = StatusCode::frame_too_dark;
    if (one_in(2)) press_at_random(has_arm);
    if (one_in(3)) rig_.trigger.hold_press(Instant(std::chrono::seconds(random_() % 40)), 5s);
    const bool may_lack_room = one_in(4);
    rig_.sink.on_attend = [this, may_lack_room] { rig_.sink.room = !may_lack_room || !one_in(2); };
    stop_after_ = one_in(4) ? static_cast<int>(random_() % 30) : 10'000;
  }

  // What the loop did; it ends.
  Seen run() {
    Seen seen;
    rig_.station.emplace(*rig_.devices, rig_.measurer, rig_.sink, rig_.stop, rig_.params);
    Station& station = *rig_.station;
    int steps = 0;
    for (; station.state() != StationState::finished && steps < 100'000; ++steps) {
      rig_.stop = steps >= stop_after_;
      const StationState before = station.state();
      seen.emplace(before, station.step());
    }
    EXPECT_EQ(station.state(), StationState::finished) << script_;
    EXPECT_FALSE(rig_.camera.is_started()) << script_;
    EXPECT_FALSE(rig_.trigger.is_started()) << script_;
    return seen;
  }

 private:
  // Somebody who looks at no lamp, also while a tray is measured.
  void press_at_random(bool has_arm) {
    for (int i = 0; i < 40; ++i) button_.add_press(Instant(std::chrono::milliseconds(random_() % 60'000)));
    button_.before_press([this] { rig_.player.handle_press(); });
    rig_.devices.emplace(
        StationDevices{rig_.camera, button_, has_arm ? &rig_.arm : nullptr, rig_.lamp, rig_.clock});
    rig_.params.takes_next_tray_early = !one_in(4);
    rig_.measurer.still_measures = [this](Nanoseconds wait) {
      rig_.clock.advance(wait);
      return !one_in(30);
    };
  }
  bool one_in(std::uint64_t count) { return random_() % count == 0; }

  std::mt19937_64 random_;
  StationRig rig_;
  SimulatedTrigger button_{rig_.clock, {}};
  std::string script_;
  int stop_after_ = 0;
};

// Each way: a transition that the table lacks, and one that it has and that never comes.
TEST(StationTable, SaysWhatTheStationDoesUnderRandomEvents) {
  const std::uint64_t seed = test::random_seed();
  Seen seen;
  for (std::uint64_t run = 0; run < 1500; ++run) {
    for (const bool has_arm : {true, false}) {
      const Seen more = RandomRun(seed + run, has_arm).run();
      seen.insert(more.begin(), more.end());
    }
  }
  for (const auto& [from, to] : seen) EXPECT_TRUE(may_follow(from, to)) << name(from) << " to " << name(to);
  for (const StationTransition& transition : station_transitions())
    EXPECT_TRUE(seen.contains({transition.from, transition.to}))
        << name(transition.from) << " to " << name(transition.to) << ": " << transition.when;
}

// From every state the station comes back to wait for a press, and ends when it is told to.
TEST(StationTable, LeadsFromEveryStateToWaitingAndToTheEnd) {
  const auto reaches = [](StationState begin, StationState goal) {
    std::set<StationState> reached{begin};
    for (std::size_t i = 0; i < kStationStateCount; ++i) {
      for (const StationTransition& transition : station_transitions()) {
        if (reached.contains(transition.from)) reached.insert(transition.to);
      }
    }
    return reached.contains(goal);
  };
  for (const StationTransition& transition : station_transitions()) {
    EXPECT_TRUE(reaches(transition.from, StationState::waiting)) << name(transition.from);
    EXPECT_TRUE(reaches(transition.from, StationState::finished)) << name(transition.from);
    EXPECT_NE(transition.from, StationState::finished);
  }
}

// The table that people read.
TEST(StationTable, StandsInTheReadme) {
  std::ifstream file(std::string(TRAYGAUGE_SOURCE_DIR) + "/firmware/README.md");
  const std::string readme{std::istreambuf_iterator<char>(file), {}};
  for (const StationTransition& transition : station_transitions()) {
    std::string row = "| ";
    row.append(name(transition.from)).append(" | ").append(name(transition.to)).append(" | ");
    row.append(transition.when).append(" |\n");
    EXPECT_NE(readme.find(row), std::string::npos) << row;
  }
}

TEST(StationTable, HasEachTransitionOnceWithASentence) {
  Seen known;
  for (const StationTransition& transition : station_transitions()) {
    EXPECT_TRUE(known.emplace(transition.from, transition.to).second)
        << name(transition.from) << " to " << name(transition.to);
    EXPECT_EQ(std::string(transition.when).back(), '.');
  }
}

}  // namespace
}  // namespace traygauge
