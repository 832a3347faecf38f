// The camera driver on a model of the kernel. Whatever a test does, nothing stays open or mapped.
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "drivers/v4l2/v4l2_camera.hpp"
#include "tests/drivers/v4l2/fake_video_device.hpp"

namespace traygauge {

class V4l2 : public testing::Test {
 protected:
  V4l2() {
    params_.device = kernel_.node;
    params_.mode = {64, 48, "", 0.0};
  }
  ~V4l2() override {
    camera_.reset();
    EXPECT_EQ(kernel_.open_now, 0);
    EXPECT_EQ(kernel_.mapped_now, 0);
  }
  V4l2Camera& camera() {
    if (!camera_) camera_.emplace(make_fake_video_device(kernel_), clock_, params_);
    return *camera_;
  }
  DeviceCode start() {
    const DeviceCode code = camera().start().code();
    buffer_.resize(camera().format().frame_bytes());
    return code;
  }
  DeviceCode capture(Nanoseconds timeout = std::chrono::seconds(2)) {
    return camera().capture(buffer_, timeout, frame_).code();
  }
  bool detail_has(const std::string& text) {
    return std::string(camera().detail()).find(text) != std::string::npos;
  }

  SimulatedClock clock_;
  FakeCamera kernel_{clock_};
  V4l2CameraParams params_;
  std::optional<V4l2Camera> camera_;
  std::vector<std::uint8_t> buffer_;
  CapturedFrame frame_;
};

}  // namespace traygauge
