// The button on gpio-sim: bounces, stuck, taken.
#include <cstdlib>

#include "drivers/gpio/gpio_trigger.hpp"
#include "tests/board/kernel_devices.hpp"
#include "tests/drivers/gpio_bench.hpp"

namespace traygauge {
namespace {

using namespace std::chrono_literals;

class ButtonOnKernel : public testing::Test {
 protected:
  ButtonOnKernel() {
    const char* const folder = std::getenv("TRAYGAUGE_BOARD_GPIO");
    bench_ = make_gpio_sim_bench(folder != nullptr ? folder : "", {"TRIGGER"});
    bench_->set_input("TRIGGER", false);
    params_.line = {"TRIGGER"};
    params_.stuck_after = 1s;
    trigger_.emplace(make_gpio_line(params_.line), clock_, params_);
  }
  void press(Nanoseconds held, int bounces) {
    for (int end = 0; end < 2; ++end) {
      for (int i = 0; i < 2 * bounces + 1; ++i) {
        bench_->set_input("TRIGGER", (i % 2 == 0) == (end == 0));
        clock_.sleep_for(2ms);
      }
      if (end == 0) clock_.sleep_for(held);
    }
  }
  SystemClock clock_;
  GpioTriggerParams params_;
  std::unique_ptr<GpioBench> bench_;
  std::optional<GpioTrigger> trigger_;
};

TEST_F(ButtonOnKernel, BouncingPressesCountOnce) {
  ASSERT_TRUE(trigger_->start().ok()) << trigger_->detail();
  const Instant begun_at = clock_.now();
  for (int i = 0; i < 3; ++i) {
    press(100ms, 3);
    clock_.sleep_for(200ms);
    EXPECT_EQ(trigger_->pending(), i + 1);  // the kernel keeps 16 edges while nobody looks
  }
  Press press_seen;
  ASSERT_TRUE(trigger_->wait_for_press(1s, press_seen).ok());
  EXPECT_GE(press_seen.at, begun_at);
  EXPECT_LT(press_seen.at - begun_at, 100ms);
}

TEST_F(ButtonOnKernel, ALongPressIsToldFromAShortOne) {
  ASSERT_TRUE(trigger_->start().ok());
  Press press_seen;
  press(100ms, 3);
  ASSERT_TRUE(trigger_->wait_for_press(1s, press_seen).ok());
  EXPECT_TRUE(trigger_->wait_for_release(500ms).ok());
  bench_->set_input("TRIGGER", true);
  ASSERT_TRUE(trigger_->wait_for_press(1s, press_seen).ok());
  EXPECT_EQ(trigger_->wait_for_release(500ms).code(), DeviceCode::timed_out);
  bench_->set_input("TRIGGER", false);
  EXPECT_TRUE(trigger_->wait_for_release(500ms).ok());
}

TEST_F(ButtonOnKernel, AStuckButtonIsToldUntilItIsReleased) {
  ASSERT_TRUE(trigger_->start().ok());
  bench_->set_input("TRIGGER", true);
  Press press_seen;
  ASSERT_TRUE(trigger_->wait_for_press(1s, press_seen).ok());
  EXPECT_EQ(trigger_->wait_for_press(5s, press_seen).code(), DeviceCode::stuck);
  trigger_->stop();
  EXPECT_EQ(trigger_->start().code(), DeviceCode::stuck);
  bench_->set_input("TRIGGER", false);
  EXPECT_TRUE(trigger_->start().ok());
}

TEST_F(ButtonOnKernel, ALineThatIsTakenIsInUse) {
  const auto holder = make_gpio_line(params_.line);
  ASSERT_TRUE(holder->open_input().ok());
  EXPECT_EQ(trigger_->start().code(), DeviceCode::in_use);
  EXPECT_EQ(trigger_->detail(), "line TRIGGER, which \"traygauge\" has taken");
  holder->close();
  EXPECT_TRUE(trigger_->start().ok());
}

TEST_F(ButtonOnKernel, IsFoundByItsChipAndNumberToo) {
  params_.line = {"board/0"};
  trigger_.emplace(make_gpio_line(params_.line), clock_, params_);
  EXPECT_TRUE(trigger_->start().ok()) << trigger_->detail();
}

TEST_F(ButtonOnKernel, AThousandStartsLeaveNoDescriptorOpen) {
  const int descriptors = open_descriptors();
  for (int i = 0; i < 1000; ++i) {
    ASSERT_TRUE(trigger_->start().ok());
    trigger_->stop();
  }
  EXPECT_EQ(open_descriptors(), descriptors);
}

}  // namespace
}  // namespace traygauge
