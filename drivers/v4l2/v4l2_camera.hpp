// A camera behind the kernel's V4L2 interface: USB cameras, and sensors that the kernel serves alike.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "drivers/camera.hpp"
#include "drivers/pixels/frame_converter.hpp"
#include "drivers/v4l2/camera_controls.hpp"
#include "drivers/v4l2/video_device.hpp"
#include "drivers/v4l2/video_modes.hpp"
#include "drivers/v4l2/video_stream.hpp"

namespace traygauge {

struct V4l2CameraParams {
  std::string device = "/dev/video0";  // see find_camera
  ModeWish mode;
  ControlWishes controls;
  // Dropped after the start, because first frames are often damaged, and then further ones while an automatic
  // that is to be held still changes the brightness. 0: none at all.
  int settle_frames = 10;
  int settle_frames_at_most = 60;  // under light that never rests; two seconds at 30 a second
  int burst = 3;                   // frames of which the sharpest counts, 1 to 8; fewer when time runs out
  // Two pictures of a real sensor never are the same bytes; those of a virtual camera are.
  bool may_repeat = false;
  Nanoseconds first_frame_timeout = std::chrono::seconds(3);  // some cameras need two seconds to begin
};

// What became of the frames since start().
struct CameraCounters {
  std::uint64_t delivered = 0;
  std::uint64_t missed = 0;   // gaps in the kernel's numbers
  std::uint64_t damaged = 0;  // marked by the kernel, too short, or no whole picture
  std::uint64_t repeated = 0;
};

class V4l2Camera final : public Camera {
 public:
  // `clock` is the one that the kernel stamps frames with: SystemClock. It outlives the camera.
  V4l2Camera(std::unique_ptr<VideoDevice> device, Clock& clock, const V4l2CameraParams& params);
  ~V4l2Camera() override { stop(); }

  const CameraCounters& counters() const { return counters_; }
  std::optional<int> held(CameraControl control) const { return controls_.held(control); }
  // While it is started: the node, the mode, and what is held: "/dev/video0: MJPEG 1600x1200 …".
  std::string describe_setup() const;

 private:
  DeviceStatus do_start() override;
  void do_stop() override;
  CameraFormat do_format() const override;
  DeviceStatus do_capture(std::span<std::uint8_t> buffer, Nanoseconds timeout, CapturedFrame& frame) override;
  DeviceStatus do_settle_again() override;

  // A frame that may be delivered.
  struct Candidate {
    FilledBuffer filled;
    CapturedFrame times;
    double sharpness = 0.0;
    std::uint64_t fingerprint = 0;
  };

  DeviceStatus open_and_set_up();
  DeviceStatus set_mode();
  void set_rate();
  DeviceStatus start_stream();
  DeviceStatus take(Instant deadline, FilledBuffer& filled);
  DeviceStatus settle();
  DeviceStatus lock_controls();
  void count(const FilledBuffer& filled);
  CapturedFrame date(const FilledBuffer& filled) const;
  DeviceStatus collect(Instant asked_at, Instant deadline);
  DeviceStatus keep_if_sharper(const Candidate& next);
  bool is_usable(const FilledBuffer& filled);
  DeviceStatus deliver_sharpest(std::span<std::uint8_t> buffer, CapturedFrame& frame);
  DeviceStatus capture_burst(Instant asked_at, Instant deadline, std::span<std::uint8_t> buffer,
                             CapturedFrame& frame);
  DeviceStatus notice_removal(DeviceStatus status);
  DeviceStatus fail(DeviceStatus status, std::string_view what);

  std::unique_ptr<VideoDevice> device_;
  Clock& clock_;
  V4l2CameraParams params_;
  VideoStream stream_;
  CameraControls controls_;
  std::string node_;
  ChosenMode mode_;
  std::optional<FrameConverter> converter_;
  std::optional<Candidate> sharpest_;         // of the burst so far
  std::optional<std::uint64_t> last_number_;  // of any frame
  std::uint64_t number_ = 0;                  // of frames, beyond the kernel's 32 bits
  std::optional<std::uint64_t> last_fingerprint_;
  bool is_open_ = false;  // the node
  bool is_gone_ = false;  // was unplugged meanwhile
  CameraCounters counters_;
};

}  // namespace traygauge
