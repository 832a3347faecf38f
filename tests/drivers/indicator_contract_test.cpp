#include <gtest/gtest.h>

#include "tests/drivers/contract_test.hpp"

namespace traygauge {
namespace {

class IndicatorContract : public ContractTest<Rig<Indicator>> {};

TEST_P(IndicatorContract, ShowsNothingBeforeItIsStarted) {
  EXPECT_EQ(device().show(Signal::ready).code(), DeviceCode::not_started);
  EXPECT_EQ(device().shown(), Signal::off);
}

TEST_P(IndicatorContract, ShowsEverySignal) {
  ASSERT_TRUE(device().start().ok());
  for (const Signal signal :
       {Signal::ready, Signal::hold_still, Signal::busy, Signal::done, Signal::try_again, Signal::move_on,
        Signal::far_enough, Signal::too_far, Signal::fault, Signal::off}) {
    ASSERT_TRUE(device().show(signal).ok()) << name(signal);
    ASSERT_TRUE(device().show(signal).ok()) << name(signal);
    EXPECT_EQ(device().shown(), signal);
  }
}

TEST_P(IndicatorContract, RefusesWhatIsNoSignal) {
  ASSERT_TRUE(device().start().ok());
  ASSERT_TRUE(device().show(Signal::busy).ok());
  EXPECT_EQ(device().show(static_cast<Signal>(99)).code(), DeviceCode::invalid_argument);
  EXPECT_EQ(device().shown(), Signal::busy);
}

TEST_P(IndicatorContract, IsOffAfterStop) {
  ASSERT_TRUE(device().start().ok());
  ASSERT_TRUE(device().show(Signal::fault).ok());
  device().stop();
  EXPECT_EQ(device().shown(), Signal::off);
}

INSTANTIATE_TEST_SUITE_P(Devices, IndicatorContract, testing::ValuesIn(indicator_rigs()), kRigName);

}  // namespace
}  // namespace traygauge
