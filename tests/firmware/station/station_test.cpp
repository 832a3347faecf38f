#include "firmware/station/station.hpp"

#include <gtest/gtest.h>

#include "tests/firmware/station/station_rig.hpp"

namespace traygauge {
namespace {

using namespace std::chrono_literals;
using enum Signal;
using Lines = std::vector<std::string>;
using Signals = std::vector<Signal>;

int volume_of(std::size_t capture) {
  return 10 * SyntheticCaptures::gray_of(capture, 0) + SyntheticCaptures::gray_of(capture, 1);
}

std::string measured(std::uint64_t scan, std::size_t capture) {
  return std::to_string(scan).append(" measured ok ").append(std::to_string(volume_of(capture)));
}

TEST(Station, MeasuresATrayFromBothViews) {
  StationRig rig(1);
  EXPECT_TRUE(rig.run().all_worked());
  EXPECT_EQ(rig.sink.lines, Lines{measured(1, 0)});
  EXPECT_EQ(rig.signals(), (Signals{ready, hold_still, busy, done}));
  ASSERT_EQ(rig.measurer.views.size(), 2U);
  EXPECT_EQ(rig.measurer.views[0].arm_angle_deg, 0.0);
  EXPECT_EQ(rig.measurer.views[1].arm_angle_deg, rig.params.second_view_deg);
}

TEST(Station, WalksThroughItsStatesInOrder) {
  StationRig rig(1);
  Station station(*rig.devices, rig.measurer, rig.sink, rig.stop);
  std::vector<StationState> states{station.state()};
  while (states.back() != StationState::finished) {
    const StationState state = station.step();
    if (state != states.back()) states.push_back(state);
  }
  using enum StationState;
  EXPECT_EQ(states, (std::vector{starting, waiting, taking_first_view, awaiting_second_view,
                                 taking_second_view, measuring, waiting, finished}));
  EXPECT_EQ(station.step(), finished);
}

TEST(Station, MeasuresSeveralTraysInARow) {
  StationRig rig(3);
  EXPECT_TRUE(rig.run().all_worked());
  EXPECT_EQ(rig.station->totals().scans, 3U);
  EXPECT_EQ(rig.sink.lines, (Lines{measured(1, 0), measured(2, 1), measured(3, 2)}));
}

TEST(Station, LetsTheExposureSettleAgainAfterAScanThatWasTooDarkOrTooBright) {
  for (const StatusCode code : {StatusCode::frame_too_dark, StatusCode::frame_too_bright}) {
    StationRig rig(3);
    rig.refuse_first_scan(code);
    rig.run();
    EXPECT_EQ(rig.camera.settled_again(), 1);
    EXPECT_EQ(rig.station->totals().measured, 2U);
  }
}

TEST(Station, LetsTheExposureSettleAgainWhenDaylightMayHaveChanged) {
  StationRig rig(3);
  rig.sink.on_delivery = [&rig] {
    if (rig.measurer.scans == 1) rig.clock.advance(11min);
  };
  EXPECT_TRUE(rig.run().all_worked());
  EXPECT_EQ(rig.camera.settled_again(), 1);
}

TEST(Station, TakesTheExposureOfCamerasThatWereStartedBeforeAsSettled) {
  StationRig rig(1);
  rig.clock.advance(11min);
  ASSERT_TRUE(rig.camera.start().ok());
  EXPECT_TRUE(rig.run().all_worked());
  EXPECT_EQ(rig.camera.settled_again(), 0);
}

TEST(Station, WorksOnTheFirstViewWhileTheArmMoves) {
  StationRig rig(1);
  rig.run();
  EXPECT_EQ(rig.measurer.arm_moving_at, (std::vector{true, false}));
}

TEST(Station, SendsTheArmHomeWhileTheVolumesAreComputed) {
  StationRig rig(1);
  double speed_deg = 0.0;
  rig.measurer.on_measure = [&] { speed_deg = rig.arm_speed(); };
  rig.run();
  EXPECT_GT(speed_deg, 0.0);
  EXPECT_EQ(rig.arm.true_position_deg(), 0.0);
}

TEST(Station, TellsTheRecordedAngleWhereThereIsOne) {
  StationRig rig(std::vector{SyntheticCapture{8, 6, 0.0, 21.5}});
  rig.run();
  EXPECT_EQ(rig.measurer.views[1].arm_angle_deg, 21.5);
}

TEST(Station, LeavesThePixelsAloneUntilTheMeasurementIsDone) {
  StationRig rig(2);
  int grays[2] = {0, 0};
  rig.measurer.on_measure = [&] {
    grays[0] = rig.measurer.views[0].frame.data[0];
    grays[1] = rig.measurer.views[1].frame.data[0];
  };
  rig.run();
  EXPECT_EQ(grays[0], SyntheticCaptures::gray_of(1, 0));
  EXPECT_EQ(grays[1], SyntheticCaptures::gray_of(1, 1));
}

TEST(Station, TakesItsFrameBuffersOnce) {
  StationRig rig(5);
  std::vector<const std::uint8_t*> places;
  rig.measurer.on_measure = [&] {
    for (const StationView& view : rig.measurer.views) places.push_back(view.frame.data);
  };
  rig.run();
  ASSERT_EQ(places.size(), 10U);
  EXPECT_NE(places[0], places[1]);
  for (std::size_t i = 2; i < places.size(); ++i) EXPECT_EQ(places[i], places[i - 2]);
}

TEST(Station, AsksToTryAgainWhenTheTrayIsNotMeasurable) {
  StationRig rig(1);
  rig.measurer.status = StatusCode::card_not_found;
  EXPECT_FALSE(rig.run().all_worked());
  EXPECT_EQ(rig.sink.lines, Lines{"1 not_measurable card_not_found"});
  EXPECT_EQ(rig.signals(), (Signals{ready, hold_still, busy, try_again}));
}

TEST(Station, MeasuresAgainOnceWhenThePicturesContradictTheArm) {
  StationRig rig(1);
  rig.measurer.disagreements = 1;
  EXPECT_TRUE(rig.run().all_worked());
  EXPECT_EQ(rig.sink.lines, Lines{"1 measured ok 320"});
  EXPECT_EQ(rig.measurer.scans, 2);
  EXPECT_EQ(rig.signals(), (Signals{ready, hold_still, busy, hold_still, busy, done}));
}

TEST(Station, RefusesWhenThePicturesContradictTheArmTwice) {
  StationRig rig(2);
  rig.measurer.disagreements = 2;
  EXPECT_FALSE(rig.run().all_worked());
  EXPECT_EQ(rig.sink.lines, (Lines{"1 device_failed simulated arm stalled", "2 measured ok 540"}));
  EXPECT_TRUE(rig.arm.true_position_deg() == 0.0);
}

TEST(Station, TellsWhenTheArmFailsOnItsWayToASecondTry) {
  StationRig rig(1);
  rig.measurer.disagreements = 1;
  rig.arm.faults().add({DeviceCode::stalled, 5, 1});
  rig.run();
  ASSERT_FALSE(rig.sink.lines.empty());
  EXPECT_EQ(rig.sink.lines[0], "1 device_failed simulated arm stalled");
}

TEST(Station, CountsAPartialMeasurementAsMeasured) {
  StationRig rig(1);
  rig.measurer.status = StatusCode::partial;
  EXPECT_TRUE(rig.run().all_worked());
  EXPECT_EQ(rig.sink.lines, Lines{std::string("1 measured partial ").append(std::to_string(volume_of(0)))});
}

TEST(Station, TakesNoSecondViewWhenTheFirstIsOfNoUse) {
  StationRig rig(1);
  rig.measurer.first_view_status = StatusCode::frame_too_dark;
  rig.run();
  EXPECT_EQ(rig.measurer.views.size(), 1U);
  EXPECT_EQ(rig.sink.lines, Lines{"1 not_measurable frame_too_dark"});
  EXPECT_EQ(rig.arm.true_position_deg(), 0.0);
}

TEST(Station, ShowsAFaultWhenTheResultGetsLost) {
  StationRig rig(1);
  rig.sink.delivery = Delivery::failed;
  EXPECT_FALSE(rig.run().all_worked());
  EXPECT_EQ(rig.signals(), (Signals{ready, hold_still, busy, fault}));
}

TEST(Station, DoesNotSayDoneWhileTheResultWaitsForTheHub) {
  StationRig rig(1);
  rig.sink.delivery = Delivery::kept;
  EXPECT_TRUE(rig.run().all_worked());
  EXPECT_EQ(rig.station->totals().kept, 1U);
  EXPECT_EQ(rig.signals(), (Signals{ready, hold_still, busy}));
}

TEST(Station, MeasuresNothingThatCouldNotBeKept) {
  StationRig rig(3);
  rig.sink.on_delivery = [&rig] { rig.sink.room = false; };
  rig.run();
  EXPECT_EQ(rig.station->totals().scans, 1U);
  EXPECT_EQ(rig.sink.lines, Lines{measured(1, 0)});
  EXPECT_EQ(rig.signals().back(), fault);
}

TEST(Station, GoesOnOnceThereIsRoomAgain) {
  StationRig rig(3);
  rig.sink.room = false;
  int looks = 0;
  rig.sink.on_attend = [&] { rig.sink.room = ++looks > 10; };
  rig.run();
  EXPECT_FALSE(rig.sink.lines.empty());
  EXPECT_EQ(rig.signals().front(), fault);
  EXPECT_EQ(rig.signals().back(), done);
}

TEST(Station, SaysWhetherTheSameTrayWasPressedForAgain) {
  for (const bool is_untouched : {true, false}) {
    StationRig rig(2);
    // The player lays the next capture under the camera; the same one again is a tray that nobody touched.
    rig.captures.same_pictures = is_untouched;
    rig.run();
    EXPECT_EQ(rig.sink.repeats, (std::vector{false, is_untouched}));
  }
}

TEST(Station, WhatIsKnownOfATrayReachesTheMeasurementAndNamesTheResult) {
  StationRig rig(1);
  rig.sink.hint = {"order 4711", 3, {"soup"}};
  rig.run();
  EXPECT_EQ(rig.measurer.hints, std::vector{rig.sink.hint});
  EXPECT_EQ(rig.sink.trays, std::vector<std::string>{"order 4711"});
}

TEST(Station, WhatWasKnownOfATrayHoldsWhenItIsMeasuredAgain) {
  for (const bool is_untouched : {true, false}) {
    StationRig rig(2);
    rig.captures.same_pictures = is_untouched;
    const TrayHint hint{"order 4711", 3, {}};
    rig.sink.hint = hint;
    rig.sink.on_delivery = [&rig] { rig.sink.hint = {}; };
    rig.run();
    EXPECT_EQ(rig.measurer.hints, (std::vector{hint, is_untouched ? hint : TrayHint()}));
  }
}

TEST(Station, ALatePressIsForANewMeal) {
  StationRig rig(2);
  rig.captures.same_pictures = true;
  rig.params.repeat_within = 1ms;
  rig.run();
  EXPECT_EQ(rig.sink.repeats, (std::vector{false, false}));
}

TEST(Station, KeepsTheResultOnTheLampForAWhile) {
  StationRig rig(2);
  rig.run();
  const auto& history = rig.lamp.history();
  ASSERT_GE(history.size(), 5U);
  ASSERT_EQ(history[3].signal, done);
  const Nanoseconds shown = history[4].since - history[3].since;
  EXPECT_GE(shown, rig.params.result_shown);
  EXPECT_LE(shown, rig.params.result_shown + 2s);  // the arm comes home meanwhile
}

TEST(Station, EndsAfterSoManyScans) {
  StationRig rig(3);
  rig.params.max_scans = 2;
  EXPECT_EQ(rig.run().scans, 2U);
}

TEST(Station, EndsWhenAskedTo) {
  StationRig rig(3);
  rig.measurer.on_measure = [&] { rig.stop = true; };
  EXPECT_EQ(rig.run().scans, 1U);
  EXPECT_FALSE(rig.camera.is_started());
  EXPECT_FALSE(rig.lamp.is_started());
}

TEST(Station, PressesDuringAScanDoNotStartAnother) {
  StationRig rig(1);
  SimulatedTrigger impatient(rig.clock,
                             {Instant(5s), Instant(5s + 100ms), Instant(5s + 200ms), Instant(20s)});
  impatient.before_press([&] { rig.player.handle_press(); });
  Station station({rig.camera, impatient, &rig.arm, rig.lamp, rig.clock}, rig.measurer, rig.sink, rig.stop);
  EXPECT_EQ(station.run().scans, 2U);
}

// Two further pictures have no place beside those that are measured: until the lamp says how it ended, a
// press starts nothing. While the arm goes home, it is one for the next tray.
TEST(Station, APressWhileATrayIsMeasuredStartsNothing) {
  for (const bool is_after_result : {false, true}) {
    StationRig rig(2);
    SimulatedTrigger impatient(rig.clock, {Instant(5s)});
    const auto press_once = [&rig, &impatient](Nanoseconds later) {
      if (rig.measurer.scans == 1) impatient.add_press(rig.clock.now() + later);
    };
    if (!is_after_result) rig.measurer.on_measure = [&] { press_once(0s); };
    rig.lamp.on_signal([&](Signal signal) {
      rig.player.handle_signal(signal);
      if (is_after_result && signal == done) press_once(1ms);
    });
    impatient.before_press([&] { rig.player.handle_press(); });
    Station station({rig.camera, impatient, &rig.arm, rig.lamp, rig.clock}, rig.measurer, rig.sink, rig.stop);
    EXPECT_EQ(station.run().scans, is_after_result ? 2U : 1U);
  }
}

// A second camera that looks at the other view.
struct TwoCameraRig : StationRig {
  explicit TwoCameraRig(std::size_t trays)
      : StationRig(trays, false),
        other_captures(trays),
        other_side(other_captures, CameraMover::hand),
        second(clock, other_side, nullptr) {
    trigger.before_press([this] {
      player.handle_press();
      other_side.handle_press();
      other_side.handle_press();
    });
    lamp.on_signal([this](Signal signal) {
      player.handle_signal(signal);
      other_side.handle_signal(signal);
    });
    devices.emplace(StationDevices{camera, trigger, nullptr, lamp, clock, &second});
    params.max_scans = trays;
  }

  SyntheticCaptures other_captures;
  TrayPlayer other_side;
  SimulatedCamera second;
};

TEST(StationWithTwoCameras, TakesBothViewsAfterOnePress) {
  TwoCameraRig rig(3);
  EXPECT_TRUE(rig.run().all_worked());
  EXPECT_EQ(rig.sink.lines, (Lines{"1 measured ok 320", "2 measured ok 540", "3 measured ok 760"}));
  EXPECT_FALSE(rig.second.is_started());
}

TEST(StationWithTwoCameras, TellsWhichOneFailsAndGoesOn) {
  TwoCameraRig rig(2);
  rig.second.faults().add({DeviceCode::device_gone, 1, 1});
  rig.run();
  EXPECT_EQ(rig.sink.lines, (Lines{"1 device_failed simulated camera device_gone", "recovery all devices",
                                   "2 measured ok 540"}));
}

TEST(StationByHand, GivesUpWhenTheSecondPressDoesNotCome) {
  StationRig rig(1, false);
  SimulatedTrigger once(rig.clock, {Instant(1s), Instant(1h)});
  once.before_press([&] { rig.player.handle_press(); });
  rig.params.max_scans = 1;
  Station station({rig.camera, once, nullptr, rig.lamp, rig.clock}, rig.measurer, rig.sink, rig.stop,
                  rig.params);
  EXPECT_FALSE(station.run().all_worked());
  EXPECT_EQ(rig.sink.lines, Lines{"1 cancelled"});
  EXPECT_EQ(rig.signals().back(), try_again);
}

TEST(Station, RunsTheSameWayEveryTime) {
  const auto history_of = [](StationRig& rig) {
    rig.camera.faults().add({DeviceCode::torn_frame, 3, 2});
    rig.arm.faults().add({DeviceCode::stalled, 9, 1});
    rig.run();
    return std::tuple(rig.lamp.history(), rig.sink.lines, rig.sink.durations);
  };
  StationRig first(4);
  StationRig second(4);
  EXPECT_EQ(history_of(first), history_of(second));
}

TEST(Station, RunsFasterThanRealTime) {
  StationRig rig(100);
  const auto begun_at = std::chrono::steady_clock::now();
  EXPECT_TRUE(rig.run().all_worked());
  EXPECT_GT(rig.clock.now(), Instant(5min));
  EXPECT_LT(std::chrono::steady_clock::now() - begun_at, 30s);
}

}  // namespace
}  // namespace traygauge
