// A press while the last tray is still measured: whether it takes the next one.
#include <gtest/gtest.h>

#include <chrono>

#include "firmware/station/background_measurer.hpp"
#include "tests/firmware/station/station_rig.hpp"

namespace traygauge {
namespace {

using namespace std::chrono_literals;
using enum Signal;
using Lines = std::vector<std::string>;
using Signals = std::vector<Signal>;

// With an arm the first tray is measured from 11.1 to 12.1 s, without one from 12.1 to 13.1 s, the others at
// once.
constexpr Instant kFirstPress(10s);
constexpr Instant kSecondViewPress(12s);
constexpr Instant kNextSecondViewPress(20s);

// While the first tray is measured.
Instant early_press(bool has_arm) {
  return has_arm ? Instant(11'500ms) : Instant(12'500ms);
}

struct BusyRig : StationRig {
  explicit BusyRig(bool has_arm)
      : StationRig(2, has_arm), button(clock, {kFirstPress, early_press(has_arm)}) {
    if (!has_arm) button.add_press(kSecondViewPress);
    button.before_press([this] {
      const bool is_early = lasted > Nanoseconds::zero() && lasted < 1s;
      if (!is_early || brings_next_tray) player.handle_press();
    });
    devices.emplace(StationDevices{camera, button, has_arm ? &arm : nullptr, lamp, clock});
    params.takes_next_tray_early = true;
    measurer.still_measures = [this](Nanoseconds wait) {
      if (measurer.scans != 1 || lasted >= 1s) return false;
      lasted += wait;
      clock.advance(wait);
      return true;
    };
  }
  void press_for_second_view_of_next() { button.add_press(kNextSecondViewPress); }

  SimulatedTrigger button;
  bool brings_next_tray = true;
  Nanoseconds lasted{0};
};

TEST(NextTray, IsTakenByHandWhileTheLastIsMeasured) {
  BusyRig rig(false);
  rig.press_for_second_view_of_next();
  EXPECT_TRUE(rig.run().all_worked());
  EXPECT_EQ(rig.sink.lines, (Lines{"1 measured ok 320", "2 measured ok 540"}));
  EXPECT_EQ(rig.signals(), (Signals{ready, hold_still, ready, hold_still, busy, hold_still, busy, done,
                                    hold_still, ready, hold_still, busy, done}));
  EXPECT_EQ(rig.sink.repeats, (std::vector{false, false}));
}

TEST(NextTray, IsTakenByTheArmOnceItIsHome) {
  BusyRig rig(true);
  EXPECT_TRUE(rig.run().all_worked());
  EXPECT_EQ(rig.sink.lines, (Lines{"1 measured ok 320", "2 measured ok 540"}));
  EXPECT_EQ(rig.signals(),
            (Signals{ready, hold_still, busy, done, hold_still, busy, hold_still, busy, done}));
  EXPECT_EQ(rig.measurer.views[0].arm_angle_deg, 0.0);
}

TEST(NextTray, IsNotTheOneThatIsMeasured) {
  for (const bool has_arm : {false, true}) {
    BusyRig rig(has_arm);
    rig.brings_next_tray = false;
    rig.run();
    EXPECT_EQ(rig.sink.lines, Lines{"1 measured ok 320"}) << has_arm;
    EXPECT_EQ(rig.station->totals().scans, 1U) << has_arm;
  }
}

TEST(NextTray, GoesOnWhereTheLastIsRefused) {
  BusyRig rig(false);
  rig.press_for_second_view_of_next();
  rig.refuse_first_scan(StatusCode::card_not_found);
  rig.run();
  EXPECT_EQ(rig.sink.lines, (Lines{"1 not_measurable card_not_found", "2 measured ok 540"}));
}

TEST(NextTray, WhosePictureFailsIsTakenAgain) {
  BusyRig rig(false);
  rig.press_for_second_view_of_next();
  // Two pictures for each view of the first tray, then all that are tried while it is measured.
  rig.camera.faults().add(
      {.action = FaultKind::torn, .after_calls = 4, .times = rig.params.capture_attempts});
  EXPECT_TRUE(rig.run().all_worked());
  EXPECT_EQ(rig.sink.lines, (Lines{"1 measured ok 320", "2 measured ok 540"}));
}

TEST(NextTray, IsTakenAgainWhereTheLastWasTooDark) {
  BusyRig rig(false);
  rig.press_for_second_view_of_next();
  rig.refuse_first_scan(StatusCode::frame_too_dark);
  rig.run();
  EXPECT_EQ(rig.sink.lines, (Lines{"1 not_measurable frame_too_dark", "2 measured ok 540"}));
  EXPECT_EQ(rig.camera.settled_again(), 1);
}

TEST(NextTray, IsNotTakenWhileTheButtonIsHeldOrNoResultCanBeKept) {
  BusyRig held(false);
  held.button.hold_press(early_press(false), 5s);
  held.run();
  EXPECT_EQ(held.sink.lines, Lines{"1 measured ok 320"});
  BusyRig full(false);
  full.measurer.on_view = [&full] { return full.sink.room = full.measurer.views.size() < 2; };
  full.run();
  EXPECT_EQ(full.sink.lines, Lines{"1 measured ok 320"});
}

TEST(NextTray, IsNotTakenByAStationThatDoesNotMeasureInTheBackground) {
  BusyRig rig(false);
  rig.params.takes_next_tray_early = false;
  rig.run();
  EXPECT_EQ(rig.sink.lines, Lines{"1 measured ok 320"});
}

// The tray that could be taken again is gone.
TEST(NextTray, IsNotTakenForTheLastOneWhoseArmStoodElsewhere) {
  BusyRig rig(true);
  rig.measurer.disagreements = 1;
  rig.run();
  EXPECT_EQ(rig.sink.lines, (Lines{"1 device_failed simulated arm stalled", "2 measured ok 540"}));
}

TEST(BackgroundMeasurer, MeasuresBesideTheLoop) {
  StationRig rig(3);
  BackgroundMeasurer measurer(rig.measurer);
  rig.params.takes_next_tray_early = true;
  Station station(*rig.devices, measurer, rig.sink, rig.stop, rig.params);
  EXPECT_TRUE(station.run().all_worked());
  EXPECT_EQ(rig.sink.lines, (Lines{"1 measured ok 320", "2 measured ok 540", "3 measured ok 760"}));
}

TEST(BackgroundMeasurer, SaysWhetherItIsDone) {
  FakeMeasurer fake;
  fake.camera_format = {8, 6, PixelFormat::bgr8};
  std::binary_semaphore may_end{0};
  fake.on_measure = [&may_end] { EXPECT_TRUE(may_end.try_acquire_for(10s)); };
  BackgroundMeasurer measurer(fake);
  measurer.begin_scan({});
  measurer.begin_measuring();
  EXPECT_EQ(measurer.await_measurement(1ms), nullptr);
  may_end.release();
  const Measurement* const measurement = measurer.await_measurement(10s);
  ASSERT_NE(measurement, nullptr);
  EXPECT_TRUE(measurement->status.ok());
}

}  // namespace
}  // namespace traygauge
