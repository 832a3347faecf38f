#include <gtest/gtest.h>

#include <thread>

#include "drivers/clock.hpp"
#include "simulator/devices/simulated_clock.hpp"

namespace traygauge {
namespace {

using namespace std::chrono_literals;

template <class T>
class ClockContract : public testing::Test {
 protected:
  T clock_;
};
using Clocks = testing::Types<SystemClock, SimulatedClock>;
TYPED_TEST_SUITE(ClockContract, Clocks);

TYPED_TEST(ClockContract, NeverGoesBack) {
  Instant last = this->clock_.now();
  for (int i = 0; i < 1000; ++i) {
    const Instant now = this->clock_.now();
    ASSERT_GE(now, last);
    last = now;
  }
}

TYPED_TEST(ClockContract, SleepsAtLeastAsLongAsAsked) {
  const Instant begun_at = this->clock_.now();
  this->clock_.sleep_for(20ms);
  EXPECT_GE(this->clock_.now() - begun_at, 20ms);
  this->clock_.sleep_until(begun_at + 30ms);
  EXPECT_GE(this->clock_.now() - begun_at, 30ms);
}

TYPED_TEST(ClockContract, DoesNotSleepIntoThePast) {
  this->clock_.sleep_for(1ms);
  const Instant begun_at = this->clock_.now();
  this->clock_.sleep_until(begun_at - 1h);
  this->clock_.sleep_for(-1h);
  this->clock_.sleep_for(0ms);
  EXPECT_LT(this->clock_.now() - begun_at, 1s);
}

TYPED_TEST(ClockContract, ServesSeveralThreads) {
  constexpr int kSleeps = 50;
  const Instant begun_at = this->clock_.now();
  const auto sleep_and_look = [this] {
    Instant last = this->clock_.now();
    for (int i = 0; i < kSleeps; ++i) {
      this->clock_.sleep_for(100us);
      const Instant now = this->clock_.now();
      EXPECT_GE(now, last + 100us);
      last = now;
    }
  };
  std::thread other(sleep_and_look);
  sleep_and_look();
  other.join();
  EXPECT_GE(this->clock_.now() - begun_at, kSleeps * 100us);
}

TEST(SystemClock, AgreesWithTheKernelsMonotonicClock) {
  const SystemClock clock;
  const auto before = std::chrono::steady_clock::now();
  const Instant now = clock.now();
  EXPECT_LE(before, now);
  EXPECT_LE(now, std::chrono::steady_clock::now());
}

TEST(SimulatedClock, MovesOnlyWhenSomebodySleeps) {
  SimulatedClock clock;
  EXPECT_EQ(clock.now(), Instant());
  EXPECT_EQ(clock.now(), Instant());
  const auto begun_at = std::chrono::steady_clock::now();
  clock.sleep_for(1000h);
  clock.advance(1h);
  EXPECT_EQ(clock.now(), Instant(1001h));
  EXPECT_LT(std::chrono::steady_clock::now() - begun_at, 10s);
}

TEST(SimulatedClock, TakesAsLongAsItSaysWhereItRunsInRealTime) {
  SimulatedClock clock;
  clock.sleep_for(1h);
  clock.run_in_real_time();
  const auto begun_at = std::chrono::steady_clock::now();
  clock.sleep_for(30ms);
  EXPECT_EQ(clock.now(), Instant(1h + 30ms));
  EXPECT_GE(std::chrono::steady_clock::now() - begun_at, 30ms);
}

}  // namespace
}  // namespace traygauge
