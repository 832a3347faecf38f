// A camera that sees recorded captures.
#pragma once

#include <chrono>
#include <vector>

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

  // Asked once a start and a capture. torn leaves half of the picture in the buffer, stale repeats the last
  // frame's number, stuck and mixed show what the sensor saw at the last capture; a frame that is late beyond
  // the timeout is lost.
  FaultScript& faults() { return faults_; }
  // How often its exposure was asked to settle again.
  int settled_again() const { return settled_again_; }

 private:
  DeviceStatus do_start() override { return faults_.next_start(clock_.now()); }
  void do_stop() override {}
  CameraFormat do_format() const override { return player_.captures().largest_frame(); }
  DeviceStatus do_capture(std::span<std::uint8_t> buffer, Nanoseconds timeout, CapturedFrame& frame) override;
  DeviceStatus do_settle_again() override {
    ++settled_again_;
    return DeviceCode::ok;
  }

  // The view that is seen now.
  PlayedFrame look() const;
  FrameView deliver(const FaultAction& fault, const PlayedFrame& seen, std::span<std::uint8_t> buffer);
  FrameView spoil(const FaultAction& fault, const FrameView& whole, std::uint64_t sequence,
                  std::span<std::uint8_t> buffer) const;
  void remember(const FrameView& view);
  FrameView pixels_of(int view) const {
    return player_.captures().pair()[static_cast<std::size_t>(view)].frame;
  }

  Clock& clock_;
  TrayPlayer& player_;
  const SimulatedArm* arm_;
  SimulatedCameraParams params_;
  FaultScript faults_;
  int settled_again_ = 0;
  std::uint64_t last_sequence_ = 0;
  FrameView last_view_;                    // that the sensor saw; in last_pixels_
  std::vector<std::uint8_t> last_pixels_;  // kept while there are faults to play
};

}  // namespace traygauge
