#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/drivers/contract_test.hpp"

namespace traygauge {
namespace {

using namespace std::chrono_literals;

constexpr double kAccuracy_deg = 0.5;  // what a scan tolerates between the commanded and the true angle

class ArmContract : public ContractTest<Rig<Arm>> {
 protected:
  void start_and_home() {
    ASSERT_TRUE(device().start().ok());
    ASSERT_TRUE(device().home(30s).ok());
  }
  double position_deg() {
    double angle_deg = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(device().read_position(angle_deg).ok());
    return angle_deg;
  }
};

TEST_P(ArmContract, DoesNothingBeforeItIsStartedAndHome) {
  double angle_deg = 0.0;
  EXPECT_EQ(device().home(1s).code(), DeviceCode::not_started);
  EXPECT_EQ(device().begin_move_to(1.0).code(), DeviceCode::not_started);
  ASSERT_TRUE(device().start().ok());
  EXPECT_FALSE(device().is_homed());
  EXPECT_EQ(device().begin_move_to(1.0).code(), DeviceCode::not_homed);
  EXPECT_EQ(device().wait_until_still(1s).code(), DeviceCode::not_homed);
  EXPECT_EQ(device().read_position(angle_deg).code(), DeviceCode::not_homed);
}

TEST_P(ArmContract, StandsAtZeroAtHome) {
  start_and_home();
  EXPECT_TRUE(device().is_homed());
  EXPECT_NEAR(position_deg(), 0.0, kAccuracy_deg);
}

TEST_P(ArmContract, GoesWhereItIsToldAndBack) {
  start_and_home();
  for (const double angle_deg : {5.0, 18.0, device().limits().max_deg, device().limits().min_deg, 0.0}) {
    ASSERT_TRUE(device().move_to(angle_deg, 30s).ok()) << angle_deg;
    EXPECT_NEAR(position_deg(), angle_deg, kAccuracy_deg);
  }
}

TEST_P(ArmContract, MovesWhileOthersWork) {
  start_and_home();
  const Instant begun_at = clock().now();
  ASSERT_TRUE(device().begin_move_to(18.0).ok());
  EXPECT_LT(clock().now() - begun_at, 50ms);
  ASSERT_TRUE(device().wait_until_still(30s).ok());
  EXPECT_GT(clock().now() - begun_at, 50ms);
  EXPECT_NEAR(position_deg(), 18.0, kAccuracy_deg);
}

TEST_P(ArmContract, RefusesAnglesBeyondItsLimitsAndStaysWhereItIs) {
  start_and_home();
  const ArmLimits limits = device().limits();
  for (const double angle_deg :
       {limits.max_deg + 1.0, limits.min_deg - 1.0, std::numeric_limits<double>::infinity(), std::nan("")}) {
    EXPECT_EQ(device().begin_move_to(angle_deg).code(), DeviceCode::out_of_range) << angle_deg;
  }
  EXPECT_NEAR(position_deg(), 0.0, kAccuracy_deg);
}

TEST_P(ArmContract, HasToGoHomeAgainAfterATimeout) {
  start_and_home();
  ASSERT_TRUE(device().begin_move_to(18.0).ok());
  EXPECT_EQ(device().wait_until_still(1ms).code(), DeviceCode::timed_out);
  EXPECT_EQ(device().begin_move_to(0.0).code(), DeviceCode::not_homed);
  ASSERT_TRUE(device().home(30s).ok());
  EXPECT_NEAR(position_deg(), 0.0, kAccuracy_deg);
}

TEST_P(ArmContract, HasToGoHomeAgainAfterItWasClosed) {
  start_and_home();
  device().stop();
  ASSERT_TRUE(device().start().ok());
  EXPECT_EQ(device().begin_move_to(0.0).code(), DeviceCode::not_homed);
}

INSTANTIATE_TEST_SUITE_P(Devices, ArmContract, testing::ValuesIn(arm_rigs()), kRigName);

}  // namespace
}  // namespace traygauge
