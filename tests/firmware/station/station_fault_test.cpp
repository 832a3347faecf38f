#include <gtest/gtest.h>

#include <random>
#include <sstream>

#include "tests/firmware/station/station_rig.hpp"

namespace traygauge {
namespace {

using namespace std::chrono_literals;
using enum Signal;
using Lines = std::vector<std::string>;
using Signals = std::vector<Signal>;

bool starts_with(const std::string& line, const std::string& beginning) {
  return line.rfind(beginning, 0) == 0;
}

TEST(StationFaults, TakesATornFrameAgain) {
  StationRig rig(1);
  rig.camera.faults().add({DeviceCode::torn_frame, 1, 2});
  EXPECT_TRUE(rig.run().all_worked());
  EXPECT_EQ(rig.signals(), (Signals{ready, hold_still, busy, done}));
}

TEST(StationFaults, NeverMeasuresAFrameThatIsTornEveryTime) {
  StationRig rig(2);
  rig.camera.faults().add({DeviceCode::torn_frame, 3, 6});  // after the start and the first view
  EXPECT_FALSE(rig.run().all_worked());
  ASSERT_EQ(rig.sink.lines.size(), 2U);
  EXPECT_EQ(rig.sink.lines[0], "1 device_failed simulated camera torn_frame");
  EXPECT_TRUE(starts_with(rig.sink.lines[1], "2 measured ok")) << rig.sink.lines[1];
  EXPECT_EQ(rig.signals(), (Signals{ready, hold_still, try_again, ready, hold_still, busy, done}));
}

TEST(StationFaults, SaysWhichPictureCannotBeReadAndGoesOn) {
  StationRig rig(std::vector{SyntheticCapture{.readable = false}, SyntheticCapture{}});
  EXPECT_EQ(rig.run().measured, 1U);
  ASSERT_EQ(rig.sink.lines.size(), 2U);
  EXPECT_EQ(rig.sink.lines[0], "1 device_failed simulated camera unreadable");
  EXPECT_TRUE(starts_with(rig.sink.lines[1], "2 measured ok"));
}

TEST(StationFaults, OpensACameraThatWentAwayAgain) {
  StationRig rig(2);
  rig.camera.faults().add({DeviceCode::device_gone, 2, 4});
  EXPECT_EQ(rig.run().measured, 1U);
  ASSERT_EQ(rig.sink.lines.size(), 3U);
  EXPECT_EQ(rig.sink.lines[0], "1 device_failed simulated camera device_gone");
  EXPECT_EQ(rig.sink.lines[1], "recovery all devices");
  EXPECT_TRUE(starts_with(rig.sink.lines[2], "2 measured ok"));
  EXPECT_EQ(rig.signals(), (Signals{ready, hold_still, fault, ready, hold_still, busy, done}));
}

TEST(StationFaults, HomesAnArmThatStalledAndGoesOn) {
  StationRig rig(2);
  rig.arm.faults().add({DeviceCode::stalled, 5, 1});  // start, home, move home (2 calls), move: then the wait
  EXPECT_EQ(rig.run().measured, 1U);
  ASSERT_EQ(rig.sink.lines.size(), 3U);
  EXPECT_EQ(rig.sink.lines[0], "1 device_failed simulated arm stalled");
  EXPECT_EQ(rig.sink.lines[1], "recovery all devices");
  EXPECT_TRUE(starts_with(rig.sink.lines[2], "2 measured ok"));
  EXPECT_EQ(rig.arm.true_position_deg(), 0.0);
}

TEST(StationFaults, ReportsAResultThoughTheArmFailsOnItsWayHome) {
  StationRig rig(1);
  rig.arm.faults().add({DeviceCode::stalled, 8, 1});
  EXPECT_EQ(rig.run().measured, 1U);
  ASSERT_EQ(rig.sink.lines.size(), 3U);
  EXPECT_TRUE(starts_with(rig.sink.lines[0], "1 measured ok"));
  EXPECT_EQ(rig.sink.lines[1], "fault simulated arm stalled");
  EXPECT_EQ(rig.sink.lines[2], "recovery all devices");
}

TEST(StationFaults, TellsADeviceThatIsMissingAtTheStartOnceAndWaitsForIt) {
  StationRig rig(1);
  rig.camera.faults().add({DeviceCode::device_gone, 0, 50});
  EXPECT_TRUE(rig.run().all_worked());
  ASSERT_EQ(rig.sink.lines.size(), 3U);
  EXPECT_EQ(rig.sink.lines[0], "fault simulated camera device_gone");
  EXPECT_EQ(rig.sink.lines[1], "recovery all devices");
  EXPECT_EQ(rig.lamp.history()[0].signal, fault);
  EXPECT_GT(rig.clock.now(), Instant(40 * rig.params.last_retry));  // it does not spin
}

TEST(StationFaults, GivesUpAfterSoManyRetriesWhenToldTo) {
  StationRig rig(1);
  rig.params.max_retries = 4;
  rig.camera.faults().add({DeviceCode::device_gone, 0, Fault::kForever});
  EXPECT_TRUE(rig.run().gave_up);
  EXPECT_FALSE(rig.station->totals().all_worked());
  EXPECT_EQ(rig.sink.lines, Lines{"fault simulated camera device_gone"});
}

TEST(StationFaults, AButtonThatFailsAgainAndAgainIsToldOnceAndAskedEverLessOften) {
  StationRig rig(1);
  rig.trigger.faults().add({DeviceCode::io_error, 1, Fault::kForever});
  rig.params.max_retries = 12;
  EXPECT_TRUE(rig.run().gave_up);
  EXPECT_EQ(rig.sink.lines, Lines{"fault simulated button io_error"});
  EXPECT_GT(rig.clock.now(), Instant(25s));
}

TEST(StationFaults, ADeadLampStopsNoScanAndIsToldOnce) {
  StationRig rig(1);
  SimulatedTrigger trigger(rig.clock, {Instant(5s), Instant(20s), Instant(40s)});
  trigger.before_press([&] { rig.player.handle_press(); });
  rig.lamp.faults().add({DeviceCode::io_error, 0, 12});
  Station station({rig.camera, trigger, &rig.arm, rig.lamp, rig.clock}, rig.measurer, rig.sink, rig.stop);
  EXPECT_EQ(station.run().measured, 3U);
  EXPECT_EQ(rig.sink.lines.front(), "fault simulated lamp io_error");
  EXPECT_EQ(std::count(rig.sink.lines.begin(), rig.sink.lines.end(), "fault simulated lamp io_error"), 1);
  EXPECT_EQ(std::count(rig.sink.lines.begin(), rig.sink.lines.end(), "recovery simulated lamp"), 1);
}

// Whatever fails, whenever and however often: each press has exactly one result, in order, a measured result
// is of two whole pictures of one tray, and the loop ends.
TEST(StationFaults, EveryPressHasOneTrueResultUnderRandomFaults) {
  constexpr DeviceCode kCodes[] = {DeviceCode::timed_out, DeviceCode::torn_frame,  DeviceCode::stale_frame,
                                   DeviceCode::stalled,   DeviceCode::device_gone, DeviceCode::io_error};
  int measured_scans = 0;
  int failed_scans = 0;
  for (unsigned seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    const auto below = [&random](unsigned bound) { return static_cast<int>(random() % bound); };
    StationRig rig(6);
    FaultScript* const scripts[] = {&rig.camera.faults(), &rig.arm.faults(), &rig.lamp.faults()};
    for (int i = 0; i < 6; ++i) scripts[below(3)]->add({kCodes[below(6)], below(40), 1 + below(8)});
    const StationTotals totals = rig.run();
    EXPECT_EQ(totals.scans, 6U);
    std::uint64_t results = 0;
    for (const std::string& line : rig.sink.lines) {
      if (starts_with(line, "fault") || starts_with(line, "recovery")) continue;
      ++results;
      const auto capture = static_cast<std::size_t>(results - 1);
      const int volume = 10 * SyntheticCaptures::gray_of(capture, 0) + SyntheticCaptures::gray_of(capture, 1);
      std::ostringstream measured;
      measured << results << " measured ok " << volume;
      std::ostringstream failed;
      failed << results << " device_failed";
      const bool is_true = line == measured.str() || starts_with(line, failed.str());
      EXPECT_TRUE(is_true) << line;
      ++(line == measured.str() ? measured_scans : failed_scans);
    }
    EXPECT_EQ(results, 6U);
    EXPECT_EQ(rig.station->state(), StationState::finished);
  }
  EXPECT_GT(measured_scans, 1000);  // both happened, often
  EXPECT_GT(failed_scans, 300);
}

}  // namespace
}  // namespace traygauge
