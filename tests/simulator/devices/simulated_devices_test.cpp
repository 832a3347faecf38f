#include <gtest/gtest.h>

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

class SimulatedStation : public testing::Test {
 protected:
  void begin(std::vector<SyntheticCapture> captures) {
    captures_.emplace(std::move(captures));
    player_.emplace(*captures_);
    arm_.emplace(clock_, &*player_);
    camera_.emplace(clock_, *player_, &*arm_);
    ASSERT_TRUE(arm_->start().ok());
    ASSERT_TRUE(arm_->home(10s).ok());
    ASSERT_TRUE(camera_->start().ok());
    buffer_.assign(camera_->format().frame_bytes(), 0);
    player_->handle_press();
  }
  DeviceCode capture() { return camera_->capture(buffer_, 2s, frame_).code(); }
  // The grey of every pixel; -1 when they differ.
  int gray() const {
    const auto bytes = static_cast<std::size_t>(3 * frame_.view.width * frame_.view.height);
    for (std::size_t i = 0; i < bytes; ++i) {
      if (buffer_[i] != buffer_[0]) return -1;
    }
    return buffer_[0];
  }

  SimulatedClock clock_;
  std::optional<SyntheticCaptures> captures_;
  std::optional<TrayPlayer> player_;
  std::optional<SimulatedArm> arm_;
  std::optional<SimulatedCamera> camera_;
  std::vector<std::uint8_t> buffer_;
  CapturedFrame frame_;
};

TEST_F(SimulatedStation, CameraSeesWhatTheArmsPlaceShows) {
  begin({SyntheticCapture{}, SyntheticCapture{}});
  for (std::size_t capture_index = 0; capture_index < 2; ++capture_index) {
    ASSERT_EQ(capture(), DeviceCode::ok);
    EXPECT_EQ(gray(), SyntheticCaptures::gray_of(capture_index, 0));
    ASSERT_TRUE(arm_->move_to(18.0, 10s).ok());
    ASSERT_EQ(capture(), DeviceCode::ok);
    EXPECT_EQ(gray(), SyntheticCaptures::gray_of(capture_index, 1));
    ASSERT_TRUE(arm_->move_to(0.0, 10s).ok());
    player_->handle_press();
  }
}

TEST_F(SimulatedStation, ArmStopsWhereTheSecondViewWasRecorded) {
  begin({SyntheticCapture{8, 6, 5.0, 22.5}});
  ASSERT_TRUE(arm_->move_to(20.0, 10s).ok());
  double angle_deg = 0.0;
  ASSERT_TRUE(arm_->read_position(angle_deg).ok());
  EXPECT_DOUBLE_EQ(angle_deg, 17.5);
  ASSERT_TRUE(arm_->move_to(0.0, 10s).ok());
  ASSERT_TRUE(arm_->read_position(angle_deg).ok());
  EXPECT_DOUBLE_EQ(angle_deg, 0.0);
}

TEST_F(SimulatedStation, SmallerCapturesUseTheBeginningOfTheBuffer) {
  begin({SyntheticCapture{.width = 4, .height = 3}, SyntheticCapture{.width = 16, .height = 12}});
  EXPECT_EQ(camera_->format().frame_bytes(), 3U * 16U * 12U);
  ASSERT_EQ(capture(), DeviceCode::ok);
  EXPECT_EQ(frame_.view.width, 4);
  EXPECT_EQ(frame_.view.height, 3);
  EXPECT_EQ(frame_.view.stride_bytes, 12);
}

TEST_F(SimulatedStation, TornFrameLeavesHalfAPicture) {
  begin({SyntheticCapture{}});
  camera_->faults().add({DeviceCode::torn_frame});
  EXPECT_EQ(capture(), DeviceCode::torn_frame);
  EXPECT_TRUE(frame_.view.empty());
  EXPECT_EQ(buffer_.front(), SyntheticCaptures::gray_of(0, 0));
  EXPECT_EQ(buffer_.back(), 0);
  EXPECT_EQ(capture(), DeviceCode::ok);
}

TEST_F(SimulatedStation, StaleFramesAreNoticed) {
  begin({SyntheticCapture{}});
  camera_->faults().add({DeviceCode::stale_frame, 1, 2});
  EXPECT_EQ(capture(), DeviceCode::ok);
  EXPECT_EQ(capture(), DeviceCode::stale_frame);
  EXPECT_EQ(capture(), DeviceCode::stale_frame);
  EXPECT_EQ(capture(), DeviceCode::ok);
}

TEST_F(SimulatedStation, CameraSaysWhichFileIsDamaged) {
  begin({SyntheticCapture{.readable = false}});
  EXPECT_EQ(capture(), DeviceCode::unreadable);
  EXPECT_EQ(camera_->detail(), "tray 0/view_0.jpg: damaged");
  player_->handle_press();
  EXPECT_EQ(capture(), DeviceCode::unreadable);
}

TEST_F(SimulatedStation, ArmMovesInSimulatedTime) {
  begin({SyntheticCapture{}});
  const Instant begun_at = clock_.now();
  ASSERT_TRUE(arm_->begin_move_to(30.0).ok());
  EXPECT_EQ(arm_->begin_move_to(0.0).code(), DeviceCode::busy);
  clock_.advance(500ms);
  EXPECT_NEAR(arm_->true_position_deg(), 15.0, 1e-9);
  ASSERT_TRUE(arm_->wait_until_still(10s).ok());
  EXPECT_EQ(clock_.now() - begun_at, 1s + SimulatedArmParams{}.settling_time);
}

TEST_F(SimulatedStation, StalledArmStandsHalfWayAndHasToGoHome) {
  begin({SyntheticCapture{}});
  arm_->faults().add({DeviceCode::stalled, 1, 1});
  EXPECT_EQ(arm_->move_to(20.0, 5s).code(), DeviceCode::stalled);
  EXPECT_NEAR(arm_->true_position_deg(), 10.0, 1e-6);
  EXPECT_FALSE(arm_->is_homed());
  ASSERT_TRUE(arm_->home(5s).ok());
  EXPECT_EQ(arm_->true_position_deg(), 0.0);
}

TEST(SimulatedTrigger, PressesOnceEachTimeTheLampSaysReadyAndThenEnds) {
  SimulatedClock clock;
  SimulatedIndicator lamp(clock);
  SimulatedTrigger trigger(clock, lamp, 2);
  int trays = 0;
  trigger.before_press([&trays] { ++trays; });
  ASSERT_TRUE(lamp.start().ok());
  ASSERT_TRUE(trigger.start().ok());
  Press press;
  EXPECT_EQ(trigger.wait_for_press(500ms, press).code(), DeviceCode::timed_out);
  for (int i = 1; i <= 2; ++i) {
    ASSERT_TRUE(lamp.show(Signal::ready).ok());
    const Instant ready_at = clock.now();
    EXPECT_EQ(trigger.wait_for_press(500ms, press).code(), DeviceCode::timed_out);
    ASSERT_EQ(trigger.wait_for_press(5s, press).code(), DeviceCode::ok);
    EXPECT_EQ(press.at, ready_at + 1s);
    EXPECT_EQ(trays, i);
    ASSERT_TRUE(lamp.show(Signal::busy).ok());
  }
  EXPECT_EQ(trigger.wait_for_press(5s, press).code(), DeviceCode::ended);
}

TEST(SimulatedIndicator, RemembersWhatItShowed) {
  SimulatedClock clock;
  SimulatedIndicator lamp(clock);
  ASSERT_TRUE(lamp.start().ok());
  ASSERT_TRUE(lamp.show(Signal::ready).ok());
  clock.advance(2s);
  ASSERT_TRUE(lamp.show(Signal::ready).ok());
  ASSERT_TRUE(lamp.show(Signal::busy).ok());
  EXPECT_EQ(lamp.history(),
            (std::vector<ShownSignal>{{Signal::ready, Instant(0s)}, {Signal::busy, Instant(2s)}}));
}

}  // namespace
}  // namespace traygauge
