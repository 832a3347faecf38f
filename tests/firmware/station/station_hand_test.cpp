// Two presses and a hand between them: what the lamp says meanwhile, and what a long press does.
#include <gtest/gtest.h>

#include "tests/firmware/station/station_rig.hpp"

namespace traygauge {
namespace {

using namespace std::chrono_literals;
using enum Signal;
using Lines = std::vector<std::string>;
using Signals = std::vector<Signal>;

TEST(StationByHand, TakesTheSecondViewAtTheSecondPress) {
  StationRig rig(2, false);
  EXPECT_TRUE(rig.run().all_worked());
  EXPECT_EQ(rig.sink.lines, (Lines{"1 measured ok 320", "2 measured ok 540"}));
  EXPECT_EQ(rig.measurer.views[1].arm_angle_deg, std::nullopt);
  const Signals twice{ready, hold_still, ready, hold_still, busy, done,
                      ready, hold_still, ready, hold_still, busy, done};
  EXPECT_EQ(rig.signals(), twice);
}

// The hand moves the camera when the lamp says so.
TEST(StationByHand, TheLampSaysMoveOnUntilItIsFarEnough) {
  StationRig rig(2, false);
  rig.measurer.guide = [&](const FrameView& live) {
    const bool at_first = live.data[0] < 100;
    return at_first ? 2.0 : 18.0;
  };
  EXPECT_TRUE(rig.run().all_worked());
  EXPECT_EQ(rig.sink.lines, (Lines{"1 measured ok 320", "2 measured ok 540"}));
  const Signals twice{ready, hold_still, move_on, far_enough, hold_still, busy, done,
                      ready, hold_still, move_on, far_enough, hold_still, busy, done};
  EXPECT_EQ(rig.signals(), twice);
}

// Its pictures get brighter while a hand moves it; it rests for the first view.
class SweptCamera final : public Camera {
 public:
  explicit SweptCamera(Clock& clock) : Camera("swept camera"), clock_(clock) {}
  static constexpr int kGrayPerStep = 20;  // a new scene
  Instant moves_from{1h};
  Nanoseconds step = 2s;
  std::function<DeviceStatus()> fault = [] { return DeviceStatus(); };

 private:
  DeviceStatus do_start() override { return DeviceCode::ok; }
  void do_stop() override {}
  CameraFormat do_format() const override { return {32, 16, PixelFormat::gray8}; }
  DeviceStatus do_capture(std::span<std::uint8_t> buffer, Nanoseconds, CapturedFrame& frame) override {
    if (const DeviceStatus status = fault(); !status.ok()) return status;
    clock_.sleep_for(30ms);
    const auto steps = std::max<std::int64_t>(0, (clock_.now() - moves_from) / step);
    std::fill(buffer.begin(), buffer.end(),
              static_cast<std::uint8_t>(std::min<std::int64_t>(255, kGrayPerStep * steps)));
    frame.view = {buffer.data(), 32, 16, 32, PixelFormat::gray8};
    frame.exposed_at = frame.delivered_at = clock_.now();
    frame.sequence = ++sequence_;
    return DeviceCode::ok;
  }
  Clock& clock_;
  std::uint64_t sequence_ = 0;
};

struct SweptRig : StationRig {
  SweptRig() : StationRig(1, false), swept(clock), button(clock, {Instant(10s), Instant(1h)}) {
    params.max_scans = 1;
    devices.emplace(StationDevices{swept, button, nullptr, lamp, clock});
    swept.moves_from = Instant(12s);
    measurer.camera_format = swept.format();
    measurer.guide = [this](const FrameView& live) -> std::optional<double> {
      ++looks;
      const int steps = live.data[0] / SweptCamera::kGrayPerStep;
      return steps == 1 ? std::nullopt : std::optional(6.0 * steps);  // the card is hidden once
    };
  }
  SweptCamera swept;
  SimulatedTrigger button;
  int looks = 0;
};

TEST(StationByHand, TheLampFollowsTheHandBeyondTheRightAngle) {
  SweptRig rig;
  rig.run();
  // 0, hidden, 12, 18, 24, 30 degrees and more; nobody presses again.
  EXPECT_EQ(rig.signals(), (Signals{ready, hold_still, move_on, far_enough, too_far, try_again}));
  EXPECT_EQ(rig.sink.lines, Lines{"1 cancelled"});
  EXPECT_LE(rig.looks, 14) << "a picture that shows nothing new is looked at again";
}

TEST(StationByHand, PicturesDamagedOnTheWayAreLeftOut) {
  SweptRig rig;
  int calls = 0;
  rig.swept.fault = [&] {
    return rig.clock.now() > Instant(12s) && ++calls % 2 == 0 ? DeviceCode::torn_frame : DeviceCode::ok;
  };
  rig.run();
  EXPECT_EQ(rig.signals(), (Signals{ready, hold_still, move_on, far_enough, too_far, try_again}));
}

TEST(StationByHand, ACameraThatIsPulledOutOnTheWayIsToldAtOnce) {
  SweptRig rig;
  rig.swept.fault = [&] {
    return rig.clock.now() > Instant(17s) && rig.clock.now() < Instant(18s) ? DeviceCode::device_gone
                                                                            : DeviceCode::ok;
  };
  rig.run();
  ASSERT_FALSE(rig.sink.lines.empty());
  EXPECT_EQ(rig.sink.lines[0], "1 device_failed swept camera device_gone");
}

struct HeldRig : StationRig {
  HeldRig(bool has_arm, const std::vector<Instant>& presses)
      : StationRig(2, has_arm), button(clock, presses) {
    button.before_press([this] { player.handle_press(); });
    devices.emplace(StationDevices{camera, button, has_arm ? &arm : nullptr, lamp, clock});
  }
  SimulatedTrigger button;
};

TEST(LongPress, SendsTheArmHomeAndOpensTheDevicesAnew) {
  HeldRig rig(true, {Instant(10s), Instant(60s)});
  rig.button.hold_press(Instant(10s), 5s);
  rig.button.before_press([&] {
    if (rig.clock.now() > Instant(50s)) rig.player.handle_press();
  });
  EXPECT_TRUE(rig.run().all_worked());
  EXPECT_EQ(rig.sink.lines, (Lines{"restart", "1 measured ok 320"}));
  EXPECT_EQ(rig.signals(), (Signals{ready, busy, ready, hold_still, busy, done}));
}

TEST(LongPress, CancelsAScanThatWaitsForItsSecondView) {
  HeldRig rig(false, {Instant(10s), Instant(15s), Instant(30s), Instant(35s)});
  rig.button.hold_press(Instant(15s), 3s);
  rig.run();
  EXPECT_EQ(rig.sink.lines, (Lines{"1 cancelled", "2 measured ok 540"}));
  EXPECT_EQ(rig.signals(), (Signals{ready, hold_still, ready, hold_still, ready, hold_still, busy, done}));
}

TEST(LongPress, APressThatIsLetGoInTimeIsAnOrdinaryOne) {
  HeldRig rig(true, {Instant(10s)});
  rig.button.hold_press(Instant(10s), 1900ms);
  EXPECT_TRUE(rig.run().all_worked());
  EXPECT_EQ(rig.sink.lines, Lines{"1 measured ok 320"});
  EXPECT_GE(rig.sink.durations[0], 1900ms);  // from the press on
}

TEST(LongPress, MeansNothingWhereItIsSwitchedOff) {
  HeldRig rig(true, {Instant(10s)});
  rig.button.hold_press(Instant(10s), 20s);
  rig.params.long_press = Nanoseconds::zero();
  EXPECT_TRUE(rig.run().all_worked());
  EXPECT_EQ(rig.sink.lines, Lines{"1 measured ok 320"});
}

}  // namespace
}  // namespace traygauge
