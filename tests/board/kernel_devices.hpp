// What the tests on a real kernel's devices share. They run in a guest, see drivers.sh.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <optional>
#include <vector>

#include "drivers/v4l2/v4l2_camera.hpp"

namespace traygauge {

// Of this process.
int open_descriptors();

// Until `is_true`, at most `timeout`.
template <class Condition>
bool comes_true(Nanoseconds timeout, const Condition& is_true) {
  SystemClock clock;
  const Instant deadline = clock.now() + timeout;
  while (!is_true()) {
    if (clock.now() > deadline) return false;
    clock.sleep_for(std::chrono::milliseconds(20));
  }
  return true;
}

class CameraOnKernel : public testing::Test {
 protected:
  DeviceCode capture(Nanoseconds timeout = std::chrono::seconds(5)) {
    return camera_->capture(buffer_, timeout, frame_).code();
  }
  DeviceCode start() {
    const DeviceStatus status = camera_->start();
    buffer_.resize(camera_->format().frame_bytes());
    return status.code();
  }
  void make_camera() { camera_.emplace(make_system_video_device(), clock_, params_); }

  SystemClock clock_;
  V4l2CameraParams params_;
  std::optional<V4l2Camera> camera_;
  std::vector<std::uint8_t> buffer_;
  CapturedFrame frame_;
};

}  // namespace traygauge
