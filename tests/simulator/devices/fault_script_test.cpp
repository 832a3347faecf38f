#include "simulator/devices/fault_script.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace traygauge {
namespace {

using namespace std::chrono_literals;
using enum FaultKind;

std::vector<FaultKind> play(FaultScript& script, int calls, FaultKinds kinds) {
  std::vector<FaultKind> played;
  for (int i = 0; i < calls; ++i) played.push_back(script.next(Instant(), kinds).kind);
  return played;
}

TEST(FaultScript, PlaysFaultsAfterSoManyCallsSoManyTimes) {
  FaultScript script;
  script.add({DeviceCode::torn_frame, 2, 2});
  script.add({DeviceCode::io_error, 5, Fault::kForever});
  std::vector<DeviceCode> played;
  for (int i = 0; i < 8; ++i) played.push_back(script.next(Instant(), {}).code());
  using enum DeviceCode;
  EXPECT_EQ(played, (std::vector{ok, ok, torn_frame, torn_frame, ok, io_error, io_error, io_error}));
  script.clear();
  EXPECT_TRUE(script.next(Instant(), {}).is(FaultKind::none));
}

TEST(FaultScript, CountsOnlyCallsThatTheKindCanSpoil) {
  FaultScript script;
  script.add({stall, 1, 1});
  EXPECT_EQ(play(script, 3, set_of({slow})), (std::vector{none, none, none}));
  EXPECT_EQ(play(script, 3, set_of({slow, stall})), (std::vector{none, stall, none}));
  EXPECT_TRUE(script.empty());
}

TEST(FaultScript, WaitsForItsTime) {
  FaultScript script;
  script.add({.action = garbage, .after_time = 2s});
  EXPECT_TRUE(script.next(Instant(1999ms), set_of({garbage})).is(none));
  EXPECT_TRUE(script.next(Instant(2s), set_of({garbage})).is(garbage));
  EXPECT_TRUE(script.next(Instant(3s), set_of({garbage})).is(none));
}

TEST(FaultScript, OffLastsUntilAStartWorks) {
  FaultScript script;
  script.add({off, 1, 2});
  EXPECT_TRUE(script.next_start(Instant()).ok());
  EXPECT_EQ(play(script, 1, set_of({off})), std::vector{off});
  EXPECT_EQ(script.next_start(Instant()).code(), DeviceCode::device_gone);
  EXPECT_EQ(play(script, 2, set_of({late})), (std::vector{off, off}));
  EXPECT_TRUE(script.next_start(Instant()).ok());
  EXPECT_EQ(play(script, 1, set_of({off})), std::vector{none});
}

// A share of 0.3 of 10,000 calls: 3000 within five standard deviations of the binomial distribution, 229.
TEST(FaultScript, AShareIsDrawnBySeedWhateverOtherFaultsDo) {
  const auto drawn = [](std::uint64_t seed, bool with_another) {
    FaultScript script;
    if (with_another) script.add({late, 100, 5000});
    script.add({.action = stuck, .times = Fault::kForever, .share = 0.3}, seed);
    return play(script, 10'000, set_of({stuck, late}));
  };
  const auto played = drawn(1, false);
  EXPECT_NEAR(static_cast<double>(std::count(played.begin(), played.end(), stuck)), 3000.0, 229.0);
  EXPECT_EQ(played, drawn(1, false));
  EXPECT_NE(played, drawn(2, false));
  const auto beside = drawn(1, true);
  for (std::size_t i = 0; i < played.size(); ++i) {
    if (beside[i] == late) continue;
    ASSERT_EQ(beside[i], played[i]) << i;
  }
}

}  // namespace
}  // namespace traygauge
