#include "drivers/gpio/gpio_trigger.hpp"

#include <gtest/gtest.h>

#include <cerrno>

#include <random>

#include "simulator/devices/simulated_clock.hpp"

namespace traygauge {
namespace {

using namespace std::chrono_literals;

// A line whose edges are known beforehand, in simulated time.
class ScriptedLine final : public GpioLine {
 public:
  struct Script {
    std::deque<GpioEdge> edges;  // by time
    bool is_active = false;
    Nanoseconds edge_delay{0};       // from the line's change until its edge can be read
    std::size_t queue_limit = 1000;  // edges beyond are lost, as in the kernel
    DeviceStatus open_status;
    DeviceStatus status;
    int open_now = 0;
  };
  ScriptedLine(SimulatedClock& clock, Script& script) : clock_(clock), script_(script) {}

  DeviceStatus open_input() override { return DeviceCode::unsupported; }
  DeviceStatus open_edges() override {
    if (script_.open_status.ok()) ++script_.open_now;
    return script_.open_status;
  }
  DeviceStatus open_output(bool) override { return DeviceCode::unsupported; }
  void close() override { script_.open_now = 0; }
  DeviceStatus read(bool& is_active) override {
    happen();
    is_active = script_.is_active;
    return script_.status;
  }
  DeviceStatus write(bool) override { return DeviceCode::unsupported; }
  DeviceStatus wait_for_edge(Nanoseconds timeout, GpioEdge& edge) override {
    if (!script_.status.ok()) return script_.status;
    const Instant deadline = clock_.now() + timeout;
    happen();
    while (queued_.empty() && !script_.edges.empty() && script_.edges.front().at <= deadline) {
      clock_.sleep_until(script_.edges.front().at);
      happen();
    }
    if (!queued_.empty() && queued_.front().at + script_.edge_delay <= deadline)
      clock_.sleep_until(queued_.front().at + script_.edge_delay);
    if (queued_.empty() || queued_.front().at + script_.edge_delay > clock_.now()) {
      clock_.sleep_until(deadline);
      return DeviceCode::timed_out;
    }
    edge = queued_.front();
    queued_.pop_front();
    return DeviceCode::ok;
  }
  std::string problem() const override { return "line TRIGGER"; }

 private:
  void happen() {
    while (!script_.edges.empty() && script_.edges.front().at <= clock_.now()) {
      const GpioEdge edge = script_.edges.front();
      script_.edges.pop_front();
      script_.is_active = edge.to_active;
      if (queued_.size() < script_.queue_limit) queued_.push_back(edge);
    }
  }
  SimulatedClock& clock_;
  Script& script_;
  std::deque<GpioEdge> queued_;
};

class Button : public testing::Test {
 protected:
  Button() { clock_.advance(1h); }
  GpioTrigger& trigger() {
    if (!trigger_) trigger_.emplace(std::make_unique<ScriptedLine>(clock_, script_), clock_, params_);
    return *trigger_;
  }
  // Closed at `at`, open `held` later, with `bounces` further closings at either end, 3 ms apart.
  void press(Instant at, Nanoseconds held, int bounces = 0) {
    const auto contact = [&](Instant from, bool to_active) {
      for (int i = 0; i < 2 * bounces + 1; ++i) {
        script_.edges.push_back({from + i * 1500us, (i % 2 == 0) == to_active});
      }
    };
    contact(at, true);
    contact(at + held, false);
  }
  std::vector<Instant> presses(Nanoseconds during) {
    std::vector<Instant> list;
    const Instant end = clock_.now() + during;
    Press press;
    while (trigger().wait_for_press(std::max(end - clock_.now(), Nanoseconds(1)), press).ok()) {
      list.push_back(press.at);
    }
    return list;
  }

  SimulatedClock clock_;
  ScriptedLine::Script script_;
  GpioTriggerParams params_;
  std::optional<GpioTrigger> trigger_;
};

TEST_F(Button, ABouncingContactIsOnePressAtItsFirstEdge) {
  const Instant begun_at = clock_.now();
  press(begun_at + 1s, 200ms, 6);
  press(begun_at + 2s, 80ms, 9);
  press(begun_at + 3s, 500ms);
  ASSERT_TRUE(trigger().start().ok());
  EXPECT_EQ(presses(5s), (std::vector{begun_at + 1s, begun_at + 2s, begun_at + 3s}));
}

TEST_F(Button, NoPressIsMissedOrCountedTwiceWhateverTheBounces) {
  std::mt19937 random(20261122);
  for (int run = 0; run < 200; ++run) {
    trigger_.reset();
    script_ = {};
    std::vector<Instant> expected;
    Instant at = clock_.now();
    for (int i = 0; i < 10; ++i) {
      at += std::chrono::milliseconds(150 + random() % 2000);
      const auto held = std::chrono::milliseconds(60 + random() % 300);
      press(at, held, static_cast<int>(random() % 8));
      expected.push_back(at);
      at += held;
    }
    ASSERT_TRUE(trigger().start().ok());
    ASSERT_EQ(presses(at - clock_.now() + 1s), expected) << "run " << run;
  }
}

// What a motor couples into the wire, alone or just before somebody presses.
TEST_F(Button, AGlitchIsNoPress) {
  const Instant begun_at = clock_.now();
  press(begun_at + 1s, 1us);
  press(begun_at + 2s, 4ms);
  press(begun_at + 3s, 3us);
  press(begun_at + 3s + 100ms, 60ms);
  for (int i = 0; i < 20; ++i) press(begun_at + 4s + i * 20ms, 5us);
  press(begun_at + 6s, 60ms);
  ASSERT_TRUE(trigger().start().ok());
  EXPECT_EQ(presses(8s), (std::vector{begun_at + 3s + 100ms, begun_at + 6s}));
}

TEST_F(Button, APressIsToldAsSoonAsItIsSure) {
  ASSERT_TRUE(trigger().start().ok());
  const Instant pressed_at = clock_.now() + 1s;
  press(pressed_at, 10s);
  Press press_seen;
  ASSERT_TRUE(trigger().wait_for_press(5s, press_seen).ok());
  EXPECT_EQ(press_seen.at, pressed_at);
  EXPECT_LE(clock_.now() - pressed_at, 6ms);
}

TEST_F(Button, APressWhoseFirstEdgeWasLostCountsOnce) {
  const Instant begun_at = clock_.now();
  press(begun_at + 1s, 100ms, 3);
  press(begun_at + 2s, 100ms, 3);
  script_.edges.pop_front();
  ASSERT_TRUE(trigger().start().ok());
  EXPECT_EQ(presses(4s), (std::vector{begun_at + 1s + 1500us, begun_at + 2s}));
}

// The line may be read between its change and the edge.
TEST_F(Button, NoPressIsLostWhenTheLineIsAheadOfItsEdge) {
  script_.edge_delay = 5ms;
  ASSERT_TRUE(trigger().start().ok());
  for (int i = 0; i < 100; ++i) {
    press(clock_.now() + std::chrono::microseconds(200'100 * (i % 7) + 10'000), 100ms);
    const Instant pressed_at = script_.edges.front().at;
    Press seen;
    DeviceStatus status = DeviceCode::timed_out;
    // Looks at the line every 2 ms.
    for (int look = 0; look < 2000 && !status.ok(); ++look) status = trigger().wait_for_press(2ms, seen);
    ASSERT_TRUE(status.ok()) << i;
    EXPECT_EQ(seen.at, pressed_at);
    ASSERT_TRUE(trigger().wait_for_release(1s).ok());
    clock_.sleep_for(300ms);
  }
}

TEST_F(Button, PressesWaitAndAreForgottenOnRequest) {
  ASSERT_TRUE(trigger().start().ok());
  press(clock_.now() + 1s, 100ms, 2);
  press(clock_.now() + 2s, 100ms, 2);
  clock_.sleep_for(3s);
  EXPECT_EQ(trigger().pending(), 2);
  EXPECT_EQ(presses(1s).size(), 2U);
  press(clock_.now() + 1s, 100ms);
  clock_.sleep_for(3s);
  trigger().discard_pending();
  EXPECT_EQ(trigger().pending(), 0);
  EXPECT_TRUE(presses(1s).empty());
}

TEST_F(Button, IsUsableAfterTheKernelLostEdges) {
  script_.queue_limit = 1;
  ASSERT_TRUE(trigger().start().ok());
  press(clock_.now() + 1s, 100ms, 20);
  clock_.sleep_for(3s);  // only the first edge was kept: the button seems pressed
  EXPECT_EQ(presses(1s).size(), 1U);
  press(clock_.now() + 1s, 100ms);
  EXPECT_EQ(presses(3s).size(), 1U);
}

TEST_F(Button, ThatStaysPressedIsToldAndComesBack) {
  ASSERT_TRUE(trigger().start().ok());
  press(clock_.now() + 1s, 60s);
  Press press_seen;
  ASSERT_TRUE(trigger().wait_for_press(5s, press_seen).ok());
  const Instant pressed_at = press_seen.at;
  EXPECT_EQ(trigger().wait_for_press(60s, press_seen).code(), DeviceCode::stuck);
  EXPECT_NEAR(std::chrono::duration<double>(clock_.now() - pressed_at).count(), 20.0, 0.5);
  trigger().stop();
  EXPECT_EQ(trigger().start().code(), DeviceCode::stuck);
  EXPECT_EQ(trigger().detail(), "if nobody presses it, active_low or bias of [button] is wrong");
  EXPECT_EQ(script_.open_now, 0);
  clock_.sleep_for(50s);
  ASSERT_TRUE(trigger().start().ok());
  press(clock_.now() + 1s, 100ms);
  EXPECT_EQ(presses(3s).size(), 1U);
}

TEST_F(Button, SaysWhyItsLineCannotBeTaken) {
  script_.open_status = {DeviceCode::in_use, EBUSY};
  EXPECT_EQ(trigger().start().code(), DeviceCode::in_use);
  EXPECT_EQ(trigger().detail(), "line TRIGGER");
  script_.open_status = {};
  ASSERT_TRUE(trigger().start().ok());
  script_.status = {DeviceCode::device_gone, ENODEV};
  Press press_seen;
  EXPECT_EQ(trigger().wait_for_press(1s, press_seen).code(), DeviceCode::device_gone);
}

TEST(GpioPlace, IsANameOrAChipAndANumber) {
  GpioPlace place;
  ASSERT_TRUE(parse_gpio_place("TRIGGER", place));
  EXPECT_EQ(place.name, "TRIGGER");
  EXPECT_TRUE(place.chip.empty());
  ASSERT_TRUE(parse_gpio_place("/dev/gpiochip4/17", place));
  EXPECT_EQ(place.chip, "/dev/gpiochip4");
  EXPECT_EQ(place.offset, 17U);
  for (const char* bad : {"", "gpiochip0/", "/3", "gpiochip0/x", "gpiochip0/-1", "gpiochip0/1 "}) {
    EXPECT_FALSE(parse_gpio_place(bad, place)) << bad;
  }
}

TEST(GpioLine, ThatIsTakenNamesWhoHasIt) {
  EXPECT_EQ(describe_line("LAMP", {DeviceCode::in_use, EBUSY}, "other"),
            "line LAMP, which \"other\" has taken");
  EXPECT_EQ(describe_line("LAMP", {DeviceCode::in_use, EBUSY}, ""), "line LAMP");
}

TEST(GpioLine, ThatDoesNotExistIsGone) {
  for (const char* name : {"NO-SUCH-LINE", "no-such-chip/3"}) {
    const auto line = make_gpio_line({name});
    EXPECT_NE(line->open_input().code(), DeviceCode::ok);
    EXPECT_EQ(line->problem(),
              "line " + std::string(name) + ": no chip has it; gpioinfo lists those that there are");
  }
  EXPECT_EQ(make_gpio_line({""})->open_input().code(), DeviceCode::invalid_argument);
}

}  // namespace
}  // namespace traygauge
