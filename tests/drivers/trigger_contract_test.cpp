#include <gtest/gtest.h>

#include "tests/drivers/contract_test.hpp"

namespace traygauge {
namespace {

using namespace std::chrono_literals;

class TriggerContract : public ContractTest<TriggerRig> {
 protected:
  DeviceCode wait(Nanoseconds timeout) { return device().wait_for_press(timeout, press_).code(); }
  Press press_;
};

TEST_P(TriggerContract, ReportsNothingBeforeItIsStarted) {
  EXPECT_EQ(wait(1s), DeviceCode::not_started);
  EXPECT_EQ(device().pending(), 0);
}

TEST_P(TriggerContract, WaitsForThePress) {
  ASSERT_TRUE(device().start().ok());
  const Instant begun_at = clock().now();
  rig().press_after(200ms, 40ms);
  ASSERT_EQ(wait(5s), DeviceCode::ok);
  EXPECT_EQ(press_.sequence, 1U);
  EXPECT_GE(press_.at, begun_at + 200ms);
  EXPECT_LT(clock().now(), begun_at + 1s);
}

TEST_P(TriggerContract, SaysThatNobodyPressed) {
  ASSERT_TRUE(device().start().ok());
  const Instant begun_at = clock().now();
  EXPECT_EQ(wait(100ms), DeviceCode::timed_out);
  EXPECT_GE(clock().now() - begun_at, 100ms);
  EXPECT_EQ(wait(0ms), DeviceCode::invalid_argument);
}

TEST_P(TriggerContract, DeliversEachPressOnceAndInOrder) {
  ASSERT_TRUE(device().start().ok());
  rig().press_after(100ms, 40ms);
  rig().press_after(300ms, 40ms);
  clock().sleep_for(500ms);
  EXPECT_EQ(device().pending(), 2);
  ASSERT_EQ(wait(1s), DeviceCode::ok);
  const Instant first_at = press_.at;
  ASSERT_EQ(wait(1s), DeviceCode::ok);
  EXPECT_EQ(press_.sequence, 2U);
  EXPECT_GT(press_.at, first_at);
  EXPECT_EQ(wait(100ms), DeviceCode::timed_out);
}

TEST_P(TriggerContract, TellsHowLongAPressLasts) {
  EXPECT_EQ(device().wait_for_release(1s).code(), DeviceCode::not_started);
  ASSERT_TRUE(device().start().ok());
  EXPECT_EQ(device().wait_for_release(0s).code(), DeviceCode::invalid_argument);
  EXPECT_TRUE(device().wait_for_release(1s).ok());
  rig().press_after(100ms, 600ms);
  ASSERT_EQ(wait(5s), DeviceCode::ok);
  EXPECT_EQ(device().wait_for_release(200ms).code(), DeviceCode::timed_out);
  ASSERT_TRUE(device().wait_for_release(5s).ok());
  EXPECT_GE(clock().now() - press_.at, 600ms);
  EXPECT_LT(clock().now() - press_.at, 2s);
  EXPECT_EQ(device().pending(), 0);
}

TEST_P(TriggerContract, ForgetsPressesOnRequest) {
  ASSERT_TRUE(device().start().ok());
  rig().press_after(100ms, 40ms);
  clock().sleep_for(200ms);
  device().discard_pending();
  EXPECT_EQ(device().pending(), 0);
  EXPECT_EQ(wait(100ms), DeviceCode::timed_out);
}

INSTANTIATE_TEST_SUITE_P(Devices, TriggerContract, testing::ValuesIn(trigger_rigs()), kRigName);

}  // namespace
}  // namespace traygauge
