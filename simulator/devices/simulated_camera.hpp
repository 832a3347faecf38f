// A camera that sees recorded captures.
#pragma once

#include <chrono>

#include "drivers/camera.hpp"
#include "simulator/devices/fault_script.hpp"
#include "simulator/devices/simulated_arm.hpp"
#include "simulator/devices/tray_player.hpp"

namespace traygauge {

// Defaults: a webcam at 30 frames a second.
struct SimulatedCameraParams {
  Nanoseconds frame_interval = std::chrono::nanoseconds(33'333'333);
  Nanoseconds transfer_time =
      std::chrono::milliseconds(20);  // from the start of the exposure to the last byte
};

// Delivers the view of the player's tray that the arm's position shows; `unreadable` when no tray lies there.
class SimulatedCamera final : public Camera {
 public:
  // `arm`: who carries the camera; null when a hand does. All outlive the camera.
  SimulatedCamera(Clock& clock, TrayPlayer& player, const SimulatedArm* arm,
                  const SimulatedCameraParams& params = {});

  // Asked once a start and a capture. torn_frame leaves half of the picture in the buffer, stale_frame
  // repeats the last frame's number.
  FaultScript& faults() { return faults_; }

 private:
  DeviceStatus do_start() override;
  void do_stop() override {}
  CameraFormat do_format() const override { return player_.captures().largest_frame(); }
  DeviceStatus do_capture(std::span<std::uint8_t> buffer, Nanoseconds timeout, CapturedFrame& frame) override;

  Clock& clock_;
  TrayPlayer& player_;
  const SimulatedArm* arm_;
  SimulatedCameraParams params_;
  FaultScript faults_;
  std::uint64_t last_sequence_ = 0;
};

}  // namespace traygauge
