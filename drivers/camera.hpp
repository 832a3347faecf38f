// The camera over the tray.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/image_view/image_view.hpp"
#include "drivers/clock.hpp"
#include "drivers/device.hpp"
#include "drivers/device_status.hpp"

namespace traygauge {

// The largest picture that a camera delivers.
struct CameraFormat {
  int width = 0;
  int height = 0;
  PixelFormat pixels = PixelFormat::bgr8;

  constexpr std::size_t frame_bytes() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
           static_cast<std::size_t>(bytes_per_pixel(pixels));
  }
};

// A picture in the caller's buffer. `sequence` rises with every frame of the sensor; a gap is a dropped
// frame.
struct CapturedFrame {
  FrameView view;
  Instant exposed_at;    // start of the exposure
  Instant delivered_at;  // last byte in memory
  std::uint64_t sequence = 0;
};

class Camera : public Device {
 public:
  // Opens the camera and begins to stream; blocks up to a few seconds. Starting twice is no error.
  DeviceStatus start();
  // Ends streaming and closes the device; start() may follow.
  void stop();
  bool is_started() const { return started_; }
  // Fixed from start() to stop().
  CameraFormat format() const { return do_format(); }

  // Blocks until the next whole frame lies in `buffer`, at most `timeout` (> 0). `frame` views `buffer`, or
  // is empty after a failure. buffer_too_small unless `buffer` holds format().frame_bytes(); nothing is
  // written beyond these. torn_frame when the picture is incomplete, stale_frame when it is not newer than
  // the last.
  DeviceStatus capture(std::span<std::uint8_t> buffer, Nanoseconds timeout, CapturedFrame& frame);
  // Lets exposure, gain and white balance settle on what is seen now, and holds them there; blocks up to a
  // few seconds. Nothing where the camera's are fixed.
  DeviceStatus settle_again();

 protected:
  using Device::Device;

 private:
  virtual DeviceStatus do_start() = 0;
  virtual void do_stop() = 0;
  virtual CameraFormat do_format() const = 0;
  virtual DeviceStatus do_capture(std::span<std::uint8_t> buffer, Nanoseconds timeout,
                                  CapturedFrame& frame) = 0;
  virtual DeviceStatus do_settle_again() { return DeviceCode::ok; }

  bool started_ = false;
  std::optional<std::uint64_t> last_sequence_;
};

}  // namespace traygauge
