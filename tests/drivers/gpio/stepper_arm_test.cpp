#include "drivers/gpio/stepper_arm.hpp"

#include <gtest/gtest.h>

#include "tests/drivers/arm_plant.hpp"

namespace traygauge {
namespace {

using namespace std::chrono_literals;

class Stepper : public testing::Test {
 protected:
  void open(double at_deg = 5.0) {
    plant_.emplace(*bench_, at_deg);
    arm_.emplace(plant_->lines(), clock_, ArmPlant::params());
    ASSERT_TRUE(arm_->start().ok());
  }
  std::string detail() const { return std::string(arm_->detail()); }

  std::unique_ptr<GpioBench> bench_ = make_model_bench();
  SystemClock clock_;
  std::optional<ArmPlant> plant_;
  std::optional<StepperArm> arm_;
};

TEST_F(Stepper, FindsTheSwitchFromWhereverItHangs) {
  for (const double at_deg : {1.0, 0.0, -1.5, 1.1, 3.0, 44.0}) {
    open(at_deg);
    ASSERT_TRUE(arm_->home(10s).ok()) << at_deg << " " << detail();
    EXPECT_NEAR(plant_->angle_deg(), 0.0, 0.21) << at_deg;
    arm_.reset();
  }
}

TEST_F(Stepper, StandsWhereItSaysAfterEveryMove) {
  open();
  ASSERT_TRUE(arm_->home(10s).ok());
  for (const double angle_deg : {18.0, 3.3, 45.0, 0.0, 0.4}) {
    ASSERT_TRUE(arm_->move_to(angle_deg, 10s).ok()) << angle_deg << " " << detail();
    double says_deg = -1.0;
    ASSERT_TRUE(arm_->read_position(says_deg).ok());
    EXPECT_NEAR(says_deg, angle_deg, 0.051);
    EXPECT_NEAR(plant_->angle_deg(), angle_deg, 0.21);
  }
}

TEST_F(Stepper, HasTimeEnoughForItsLongestWay) {
  EXPECT_GT(longest_move({}), 12s);  // the usual homing from the upper end
  for (const double at_deg : {44.9, -0.5}) {
    open(at_deg);
    ASSERT_TRUE(arm_->home(longest_move(ArmPlant::params())).ok()) << at_deg << " " << detail();
    EXPECT_TRUE(arm_->move_to(45.0, longest_move(ArmPlant::params())).ok()) << detail();
    arm_.reset();
  }
}

TEST_F(Stepper, ThatIsBlockedWhenItLooksForHomeSaysSo) {
  open(5.0);
  plant_->is_blocked = true;
  EXPECT_EQ(arm_->home(10s).code(), DeviceCode::stalled);
  EXPECT_EQ(
      detail(),
      "the home switch did not close: check the switch, whether it is inverted, the motor and what blocks "
      "it");
  plant_->is_blocked = false;
  EXPECT_TRUE(arm_->home(10s).ok());
}

TEST_F(Stepper, WhoseSwitchHangsSaysSo) {
  open(0.0);
  plant_->switch_is_dead = true;
  EXPECT_EQ(arm_->home(10s).code(), DeviceCode::stalled);
  EXPECT_EQ(detail(),
            "the home switch stays closed: the arm does not move, or the switch hangs or is inverted");
}

TEST_F(Stepper, ThatStallsOnItsWayOutIsTold) {
  open();
  ASSERT_TRUE(arm_->home(10s).ok());
  plant_->is_blocked = true;
  EXPECT_EQ(arm_->move_to(18.0, 10s).code(), DeviceCode::stalled);
  EXPECT_EQ(detail(), "away from home the home switch is closed: the arm does not move");
  EXPECT_FALSE(arm_->is_homed());
}

TEST_F(Stepper, ThatLostStepsIsToldWhenItComesBack) {
  open();
  ASSERT_TRUE(arm_->home(10s).ok());
  ASSERT_TRUE(arm_->move_to(18.0, 10s).ok());
  plant_->lose_every = 10;
  EXPECT_EQ(arm_->move_to(0.0, 10s).code(), DeviceCode::stalled);
  EXPECT_EQ(detail(), "back at 0 the home switch is open: steps were lost");
  plant_->lose_every = 0;
  ASSERT_TRUE(arm_->home(10s).ok());
  EXPECT_TRUE(arm_->move_to(18.0, 10s).ok());
}

// A real switch opens further out than it closes, and never twice at the same place.
TEST_F(Stepper, ComesBackAgainAndAgainToASwitchThatJitters) {
  open();
  ASSERT_TRUE(arm_->home(10s).ok());
  for (int i = 0; i < 20; ++i) {
    ASSERT_TRUE(arm_->move_to(4.0, 10s).ok()) << i << " " << detail();
    ASSERT_TRUE(arm_->move_to(0.0, 10s).ok()) << i << " " << detail();
  }
}

TEST_F(Stepper, ThatLostLessThanADegreeIsToldWhenItComesBack) {
  open();
  ASSERT_TRUE(arm_->home(10s).ok());
  ASSERT_TRUE(arm_->move_to(18.0, 10s).ok());
  plant_->lose_every = 20;
  EXPECT_EQ(arm_->move_to(0.0, 10s).code(), DeviceCode::stalled);
  EXPECT_EQ(detail(), "on the way back the home switch closed too late: steps were lost");
}

TEST_F(Stepper, ThatStalledHalfWayOutIsToldOnItsWayBackAndStopsThere) {
  open();
  ASSERT_TRUE(arm_->home(10s).ok());
  plant_->block_at_deg = 9.0;
  ASSERT_TRUE(arm_->move_to(18.0, 10s).ok());
  plant_->block_at_deg = 90.0;
  EXPECT_EQ(arm_->move_to(0.0, 10s).code(), DeviceCode::stalled);
  EXPECT_EQ(detail(),
            "on the way back the home switch closed too early: the arm had not gone as far as it was told");
  EXPECT_GT(plant_->angle_deg(), 0.5) << "it would be driven against its stop";
  EXPECT_TRUE(arm_->home(10s).ok());
}

TEST_F(Stepper, GoesHomeFromTheMiddleOfAMove) {
  open();
  ASSERT_TRUE(arm_->home(10s).ok());
  ASSERT_TRUE(arm_->begin_move_to(45.0).ok());
  clock_.sleep_for(30ms);
  ASSERT_TRUE(arm_->home(10s).ok()) << detail();
  EXPECT_NEAR(plant_->angle_deg(), 0.0, 0.21);
  double says_deg = -1.0;
  ASSERT_TRUE(arm_->read_position(says_deg).ok());
  EXPECT_EQ(says_deg, 0.0);
}

TEST_F(Stepper, HaltsAtATimeoutAndWhenItIsClosed) {
  open();
  ASSERT_TRUE(arm_->home(10s).ok());
  ASSERT_TRUE(arm_->begin_move_to(45.0).ok());
  EXPECT_EQ(arm_->begin_move_to(1.0).code(), DeviceCode::busy);
  EXPECT_EQ(arm_->wait_until_still(20ms).code(), DeviceCode::timed_out);
  const long pulses = plant_->pulses;
  clock_.sleep_for(50ms);
  EXPECT_EQ(plant_->pulses, pulses);
  ASSERT_TRUE(arm_->home(10s).ok());
  ASSERT_TRUE(arm_->begin_move_to(45.0).ok());
  arm_->stop();
  const long at_stop = plant_->pulses;
  clock_.sleep_for(50ms);
  EXPECT_EQ(plant_->pulses, at_stop);
  EXPECT_EQ(plant_->switched_off, 1);
}

TEST_F(Stepper, SaysWhichLineIsTaken) {
  const auto taken = bench_->make_line("DIR");
  ASSERT_TRUE(taken->open_input().ok());
  plant_.emplace(*bench_);
  arm_.emplace(plant_->lines(), clock_, ArmPlant::params());
  EXPECT_EQ(arm_->start().code(), DeviceCode::in_use);
  EXPECT_EQ(detail(), "line DIR");
  taken->close();
  EXPECT_TRUE(arm_->start().ok());
}

}  // namespace
}  // namespace traygauge
