#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/drivers/contract_test.hpp"

namespace traygauge {
namespace {

using namespace std::chrono_literals;

class CameraContract : public ContractTest<Rig<Camera>> {
 protected:
  DeviceCode capture(Nanoseconds timeout = 2s) { return device().capture(buffer_, timeout, frame_).code(); }
  void start() {
    ASSERT_TRUE(device().start().ok());
    buffer_.resize(device().format().frame_bytes());
  }
  std::vector<std::uint8_t> buffer_;
  CapturedFrame frame_;
};

TEST_P(CameraContract, DeliversNothingBeforeItIsStarted) {
  buffer_.resize(device().format().frame_bytes());
  EXPECT_EQ(capture(), DeviceCode::not_started);
  EXPECT_TRUE(frame_.view.empty());
}

TEST_P(CameraContract, StartsTwiceStopsTwiceAndStartsAgain) {
  start();
  EXPECT_TRUE(device().start().ok());
  device().stop();
  device().stop();
  EXPECT_EQ(capture(), DeviceCode::not_started);
  start();
  EXPECT_EQ(capture(), DeviceCode::ok);
}

TEST_P(CameraContract, FillsTheCallersBufferWithNewFrames) {
  start();
  std::uint64_t last_sequence = 0;
  for (int i = 0; i < 5; ++i) {
    const Instant asked_at = clock().now();
    ASSERT_EQ(capture(), DeviceCode::ok);
    EXPECT_EQ(frame_.view.data, buffer_.data());
    EXPECT_LE(frame_.view.width, device().format().width);
    EXPECT_LE(frame_.view.height, device().format().height);
    EXPECT_LT(frame_.exposed_at, frame_.delivered_at);
    EXPECT_LE(frame_.delivered_at, clock().now());
    EXPECT_LE(asked_at, frame_.delivered_at);
    EXPECT_TRUE(i == 0 || frame_.sequence > last_sequence);
    last_sequence = frame_.sequence;
  }
}

TEST_P(CameraContract, LeavesABufferThatIsTooSmallAlone) {
  start();
  buffer_.assign(device().format().frame_bytes() - 1, 0xA5);
  EXPECT_EQ(capture(), DeviceCode::buffer_too_small);
  EXPECT_TRUE(frame_.view.empty());
  EXPECT_TRUE(std::all_of(buffer_.begin(), buffer_.end(), [](auto byte) { return byte == 0xA5; }));
}

TEST_P(CameraContract, LeavesWhatLiesBehindTheFrameAlone) {
  start();
  const std::size_t frame_bytes = device().format().frame_bytes();
  buffer_.assign(frame_bytes + 64, 0xA5);
  ASSERT_EQ(capture(), DeviceCode::ok);
  EXPECT_TRUE(std::all_of(buffer_.begin() + static_cast<std::ptrdiff_t>(frame_bytes), buffer_.end(),
                          [](auto byte) { return byte == 0xA5; }));
}

TEST_P(CameraContract, RefusesToWaitNoTime) {
  start();
  EXPECT_EQ(capture(0s), DeviceCode::invalid_argument);
  EXPECT_EQ(capture(-1s), DeviceCode::invalid_argument);
}

TEST_P(CameraContract, KeepsToItsTimeout) {
  start();
  const Instant asked_at = clock().now();
  EXPECT_EQ(capture(1us), DeviceCode::timed_out);  // shorter than any exposure and transfer
  EXPECT_TRUE(frame_.view.empty());
  EXPECT_LT(clock().now() - asked_at, 100ms);
}

INSTANTIATE_TEST_SUITE_P(Devices, CameraContract, testing::ValuesIn(camera_rigs()), kRigName);

// A camera that says what the test wants.
class ScriptedCamera final : public Camera {
 public:
  ScriptedCamera() : Camera("scripted camera") {}
  CapturedFrame next;
  std::span<std::uint8_t> given;

 private:
  DeviceStatus do_start() override { return DeviceCode::ok; }
  void do_stop() override {}
  CameraFormat do_format() const override { return {4, 3, PixelFormat::bgr8}; }
  DeviceStatus do_capture(std::span<std::uint8_t> buffer, Nanoseconds, CapturedFrame& frame) override {
    given = buffer;
    frame = next;
    return DeviceCode::ok;
  }
};

class CameraBase : public testing::Test {
 protected:
  CameraBase() {
    EXPECT_TRUE(camera_.start().ok());
    camera_.next.view = {buffer_.data(), 4, 3, 12, PixelFormat::bgr8};
  }
  DeviceCode capture() {
    ++camera_.next.sequence;
    return camera_.capture(buffer_, 1s, frame_).code();
  }
  ScriptedCamera camera_;
  std::vector<std::uint8_t> buffer_ = std::vector<std::uint8_t>(50);
  CapturedFrame frame_;
};

TEST_F(CameraBase, NeverHandsOutMoreThanAFrame) {
  EXPECT_EQ(capture(), DeviceCode::ok);
  EXPECT_EQ(camera_.given.size(), 36U);
}

TEST_F(CameraBase, CallsAFrameThatLeavesTheBufferTorn) {
  for (const FrameView& view : {FrameView{buffer_.data(), 4, 4, 12, PixelFormat::bgr8},
                                FrameView{buffer_.data() + 1, 4, 3, 12, PixelFormat::bgr8},
                                FrameView{buffer_.data(), 4, 3, 11, PixelFormat::bgr8},
                                FrameView{buffer_.data() + 36, 1, 1, 3, PixelFormat::bgr8}, FrameView{}}) {
    camera_.next.view = view;
    EXPECT_EQ(capture(), DeviceCode::torn_frame);
    EXPECT_TRUE(frame_.view.empty());
  }
}

TEST_F(CameraBase, CallsARepeatedFrameStaleUntilTheNextStart) {
  ASSERT_EQ(capture(), DeviceCode::ok);
  camera_.next.sequence -= 1;
  EXPECT_EQ(capture(), DeviceCode::stale_frame);
  camera_.stop();
  ASSERT_TRUE(camera_.start().ok());
  camera_.next.sequence -= 1;
  EXPECT_EQ(capture(), DeviceCode::ok);
}

}  // namespace
}  // namespace traygauge
