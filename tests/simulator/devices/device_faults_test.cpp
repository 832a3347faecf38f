// What each kind of fault does to the device that plays it.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "simulator/devices/simulated_arm.hpp"
#include "simulator/devices/simulated_camera.hpp"
#include "simulator/devices/simulated_clock.hpp"
#include "simulator/devices/simulated_indicator.hpp"
#include "simulator/devices/simulated_trigger.hpp"
#include "tests/simulator/devices/synthetic_captures.hpp"

namespace traygauge {
namespace {

using namespace std::chrono_literals;
using enum FaultKind;

class FaultyCamera : public testing::Test {
 protected:
  FaultyCamera() : captures_(2), player_(captures_), arm_(clock_, &player_), camera_(clock_, player_, &arm_) {
    EXPECT_TRUE(arm_.start().ok());
    EXPECT_TRUE(arm_.home(10s).ok());
    EXPECT_TRUE(camera_.start().ok());
    buffer_.assign(camera_.format().frame_bytes(), 0);
    player_.handle_press();
  }
  DeviceCode capture() { return camera_.capture(buffer_, 2s, frame_).code(); }
  void go_to_second_view() { ASSERT_TRUE(arm_.move_to(18.0, 10s).ok()); }
  int first_row() const { return frame_.view.data[0]; }
  int last_row() const { return frame_.view.data[(frame_.view.height - 1) * frame_.view.stride_bytes]; }
  static int gray(int view) { return SyntheticCaptures::gray_of(0, view); }

  SimulatedClock clock_;
  SyntheticCaptures captures_;
  TrayPlayer player_;
  SimulatedArm arm_;
  SimulatedCamera camera_;
  std::vector<std::uint8_t> buffer_;
  CapturedFrame frame_;
};

TEST_F(FaultyCamera, OffIsGoneUntilItIsStartedAgain) {
  camera_.faults().add({off});
  const Instant before = clock_.now();
  for (int i = 0; i < 3; ++i) EXPECT_EQ(capture(), DeviceCode::device_gone);
  EXPECT_EQ(clock_.now(), before);
  camera_.stop();
  ASSERT_TRUE(camera_.start().ok());
  EXPECT_EQ(capture(), DeviceCode::ok);
}

TEST_F(FaultyCamera, StuckShowsTheLastPictureUnderANewNumber) {
  camera_.faults().add({stuck, 1, 2});
  ASSERT_EQ(capture(), DeviceCode::ok);
  std::uint64_t sequence = frame_.sequence;
  go_to_second_view();
  for (int i = 0; i < 2; ++i) {
    ASSERT_EQ(capture(), DeviceCode::ok);
    EXPECT_EQ(first_row(), gray(0));
    EXPECT_GT(frame_.sequence, sequence);
    EXPECT_EQ(player_.find_played(frame_.sequence).value().view, 0);
    sequence = frame_.sequence;
  }
  ASSERT_EQ(capture(), DeviceCode::ok);
  EXPECT_EQ(first_row(), gray(1));
}

TEST_F(FaultyCamera, LateArrivesLaterOrAfterTheTimeoutNever) {
  ASSERT_EQ(capture(), DeviceCode::ok);
  const Nanoseconds usual = frame_.delivered_at - frame_.exposed_at;
  camera_.faults().add({FaultAction(late, 500.0)});
  camera_.faults().add({FaultAction(late, 5000.0)});
  ASSERT_EQ(capture(), DeviceCode::ok);
  EXPECT_EQ(frame_.delivered_at - frame_.exposed_at, usual + 500ms);
  EXPECT_EQ(clock_.now(), frame_.delivered_at);
  const Instant before = clock_.now();
  EXPECT_EQ(capture(), DeviceCode::timed_out);
  EXPECT_EQ(clock_.now() - before, 2s);
  EXPECT_EQ(capture(), DeviceCode::ok);
}

TEST_F(FaultyCamera, GarbageIsNoiseDeliveredAsAPictureTheSameEveryTime) {
  camera_.faults().add({garbage, 0, 2});
  ASSERT_EQ(capture(), DeviceCode::ok);
  const auto first = buffer_;
  EXPECT_GT(*std::max_element(first.begin(), first.end()) - *std::min_element(first.begin(), first.end()),
            150);
  ASSERT_EQ(capture(), DeviceCode::ok);
  EXPECT_NE(buffer_, first);
}

TEST_F(FaultyCamera, MixedHasRowsOfTwoViews) {
  camera_.faults().add({FaultAction(mixed, 0.5), 1, 1});
  camera_.faults().add({FaultAction(mixed, -0.2), 3, 1});
  ASSERT_EQ(capture(), DeviceCode::ok);
  go_to_second_view();
  ASSERT_EQ(capture(), DeviceCode::ok);
  EXPECT_EQ(first_row(), gray(1));
  EXPECT_EQ(last_row(), gray(0));
  ASSERT_EQ(capture(), DeviceCode::ok);
  EXPECT_EQ(last_row(), gray(1));
  ASSERT_TRUE(arm_.move_to(0.0, 10s).ok());
  ASSERT_EQ(capture(), DeviceCode::ok);
  EXPECT_EQ(first_row(), gray(1));
  EXPECT_EQ(last_row(), gray(0));
}

TEST_F(FaultyCamera, WrongSizeDeliversAPart) {
  camera_.faults().add({FaultAction(wrong_size, 0.5)});
  ASSERT_EQ(capture(), DeviceCode::ok);
  EXPECT_EQ(frame_.view.width, 4);
  EXPECT_EQ(frame_.view.height, 3);
}

class FaultyArm : public testing::Test {
 protected:
  FaultyArm() : arm_(clock_) {
    EXPECT_TRUE(arm_.start().ok());
    EXPECT_TRUE(arm_.home(10s).ok());
  }
  double said_deg() {
    double angle_deg = -1.0;
    EXPECT_TRUE(arm_.read_position(angle_deg).ok());
    return angle_deg;
  }
  // Moves there; true where the arm says that it arrived.
  bool arrives_at(double angle_deg) { return arm_.move_to(angle_deg, 10s).ok(); }

  SimulatedClock clock_;
  SimulatedArm arm_;
};

TEST_F(FaultyArm, OffStopsWhereItIs) {
  arm_.faults().add({off, 1, 1});
  EXPECT_EQ(arm_.move_to(20.0, 10s).code(), DeviceCode::device_gone);
  EXPECT_EQ(arm_.true_position_deg(), 0.0);
  EXPECT_EQ(arm_.begin_move_to(10.0).code(), DeviceCode::not_homed);
  EXPECT_EQ(arm_.home(10s).code(), DeviceCode::device_gone);
  arm_.stop();
  ASSERT_TRUE(arm_.start().ok());
  ASSERT_TRUE(arm_.home(10s).ok());
  EXPECT_TRUE(arrives_at(20.0));
}

TEST_F(FaultyArm, WrongAngleShiftsEveryPlaceUntilItGoesHome) {
  arm_.faults().add({FaultAction(wrong_angle, 3.0)});
  ASSERT_TRUE(arrives_at(20.0));
  EXPECT_EQ(said_deg(), 20.0);
  EXPECT_NEAR(arm_.true_position_deg(), 23.0, 1e-9);
  ASSERT_TRUE(arrives_at(0.0));
  EXPECT_NEAR(arm_.true_position_deg(), 3.0, 1e-9);
  ASSERT_TRUE(arm_.home(10s).ok());
  EXPECT_EQ(arm_.true_position_deg(), 0.0);
  EXPECT_EQ(said_deg(), 0.0);
}

TEST_F(FaultyArm, SilentStallStopsHalfWayAndSaysItArrived) {
  arm_.faults().add({silent_stall});
  ASSERT_TRUE(arrives_at(20.0));
  EXPECT_EQ(said_deg(), 20.0);
  EXPECT_NEAR(arm_.true_position_deg(), 10.0, 1e-9);
}

TEST_F(FaultyArm, StuckStaysAndSaysItArrived) {
  arm_.faults().add({stuck});
  ASSERT_TRUE(arm_.begin_move_to(20.0).ok());
  clock_.advance(200ms);
  EXPECT_NEAR(arm_.true_position_deg(), 0.0, 1e-9);
  ASSERT_TRUE(arm_.wait_until_still(10s).ok());
  EXPECT_EQ(said_deg(), 20.0);
  EXPECT_NEAR(arm_.true_position_deg(), 0.0, 1e-9);
}

TEST_F(FaultyArm, StallStopsHalfWayAndSaysSo) {
  arm_.faults().add({stall});
  EXPECT_EQ(arm_.move_to(20.0, 10s).code(), DeviceCode::stalled);
  EXPECT_NEAR(arm_.true_position_deg(), 10.0, 1e-6);
  EXPECT_FALSE(arm_.is_homed());
}

TEST_F(FaultyArm, SlowTakesSoManyTimesAsLongUpToTheTimeout) {
  arm_.faults().add({FaultAction(slow, 4.0)});
  arm_.faults().add({FaultAction(slow, 100.0)});
  const Instant before = clock_.now();
  ASSERT_TRUE(arrives_at(15.0));
  EXPECT_EQ(clock_.now() - before, 2s + SimulatedArmParams{}.settling_time);
  EXPECT_EQ(arm_.move_to(0.0, 10s).code(), DeviceCode::timed_out);
}

class FaultyButton : public testing::Test {
 protected:
  FaultyButton() : lamp_(clock_), button_(clock_, lamp_, 2) {
    button_.before_press([this] { ++trays_; });
    EXPECT_TRUE(lamp_.start().ok());
    EXPECT_TRUE(button_.start().ok());
    EXPECT_TRUE(lamp_.show(Signal::ready).ok());
  }
  DeviceCode wait(Nanoseconds timeout) { return button_.wait_for_press(timeout, press_).code(); }

  SimulatedClock clock_;
  SimulatedIndicator lamp_;
  SimulatedTrigger button_;
  Press press_;
  int trays_ = 0;
};

TEST_F(FaultyButton, StuckLosesPressesUntilThePersonGoesAway) {
  button_.faults().add({stuck, 0, 2});
  EXPECT_EQ(wait(50s), DeviceCode::timed_out);
  EXPECT_EQ(wait(50s), DeviceCode::ok);
  EXPECT_EQ(press_.at, Instant(1s + 2 * PersonParams{}.patience));
  EXPECT_EQ(press_.sequence, 1U);
  EXPECT_EQ(trays_, 1);
  button_.faults().add({stuck, 0, Fault::kForever});
  EXPECT_EQ(wait(PersonParams{}.tries * PersonParams{}.patience), DeviceCode::ended);
}

TEST_F(FaultyButton, BounceGivesSeveralEdgesOfOnePress) {
  button_.faults().add({FaultAction(bounce, 5.0)});
  ASSERT_EQ(wait(2s), DeviceCode::ok);
  ASSERT_EQ(wait(2s), DeviceCode::ok);
  EXPECT_LT(press_.at - Instant(1s), 10ms);
  clock_.advance(20ms);
  EXPECT_EQ(button_.pending(), 3);
  button_.discard_pending();
  EXPECT_EQ(button_.pending(), 0);
  EXPECT_EQ(trays_, 1);
}

TEST_F(FaultyButton, LateIsSeenLaterWithItsTrueTime) {
  button_.faults().add({FaultAction(late, 3000.0)});
  EXPECT_EQ(wait(2s), DeviceCode::timed_out);
  EXPECT_EQ(trays_, 0);
  ASSERT_EQ(wait(3s), DeviceCode::ok);
  EXPECT_EQ(press_.at, Instant(1s));
  EXPECT_EQ(clock_.now(), Instant(4s));
}

TEST_F(FaultyButton, IsTriedAfterAWhileUnderADarkLamp) {
  ASSERT_EQ(wait(2s), DeviceCode::ok);
  lamp_.faults().add({off});
  EXPECT_EQ(lamp_.show(Signal::busy).code(), DeviceCode::device_gone);
  EXPECT_EQ(lamp_.seen().signal, Signal::off);
  ASSERT_EQ(wait(1min), DeviceCode::ok);
  EXPECT_EQ(press_.at, Instant(1s) + PersonParams{}.patience);
}

TEST(FaultyLamp, StuckGoesOnShowingWhatItShowed) {
  SimulatedClock clock;
  SimulatedIndicator lamp(clock);
  lamp.faults().add({stuck, 1, 1});
  ASSERT_TRUE(lamp.start().ok());
  ASSERT_TRUE(lamp.show(Signal::ready).ok());
  ASSERT_TRUE(lamp.show(Signal::busy).ok());
  EXPECT_EQ(lamp.seen().signal, Signal::ready);
  ASSERT_TRUE(lamp.show(Signal::done).ok());
  EXPECT_EQ(lamp.seen().signal, Signal::done);
}

TEST(FaultyClock, LateAndSlowSleepsLastLonger) {
  SimulatedClock clock;
  clock.faults().add({FaultAction(late, 250.0)});
  clock.faults().add({FaultAction(slow, 3.0)});
  clock.sleep_for(1s);
  EXPECT_EQ(clock.now(), Instant(1250ms));
  clock.sleep_for(1s);
  EXPECT_EQ(clock.now(), Instant(4250ms));
  clock.sleep_for(1s);
  EXPECT_EQ(clock.now(), Instant(5250ms));
}

}  // namespace
}  // namespace traygauge
