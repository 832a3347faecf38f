// A small model of the kernel behind a camera: buffers, controls and frames in simulated time, with faults.
// It counts what is held, and fails the test on requests that the kernel would punish.
#pragma once

#include <linux/videodev2.h>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "drivers/v4l2/video_device.hpp"
#include "simulator/devices/simulated_clock.hpp"

namespace traygauge {

struct FakeMode {
  std::uint32_t fourcc = V4L2_PIX_FMT_YUYV;
  std::uint32_t width = 64;
  std::uint32_t height = 48;
  std::vector<std::uint32_t> rates_per_s = {30};
  // A range up to width x height, in steps of 8: from here on. At `rates_at_least` there are these rates.
  std::uint32_t least_width = 0;
  std::uint32_t least_height = 0;
  std::vector<std::uint32_t> rates_at_least = {};
};

struct FakeControl {
  int minimum = 0;
  int maximum = 100;
  int step = 1;
  int value = 0;
  bool is_stubborn = false;  // takes a value and keeps its own
  // Which control's automatic moves `value`, and the last value that was set by hand, to which this one goes
  // back when that automatic is switched off; 0: none.
  std::uint32_t automatic = 0;
  int by_hand = 0;
};

// What is special about the frames from one on, by their number since the camera was made.
struct FakeFrame {
  std::uint32_t flags = 0;
  double length_fraction = 1.0;
  bool is_lost = false;
};

// What the camera sees, and everything that survives a replug. Outlives the devices.
struct FakeCamera {
  explicit FakeCamera(SimulatedClock& clock_) : clock(clock_) {}

  SimulatedClock& clock;
  std::string node = "/dev/video7";
  std::vector<FakeMode> modes = {FakeMode{}};
  std::map<std::uint32_t, FakeControl> controls = {{V4L2_CID_EXPOSURE_AUTO, {0, 3, 1, 3}},
                                                   {V4L2_CID_EXPOSURE_ABSOLUTE, {1, 5000, 1, 156}}};
  std::map<int, FakeFrame> frames;                    // those with something special
  std::map<int, std::vector<std::uint8_t>> pictures;  // from this frame on, instead of noise
  std::uint32_t stamp_flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC | V4L2_BUF_FLAG_TSTAMP_SRC_SOE;
  std::optional<Nanoseconds> fixed_stamp;  // of every frame, since the clock's start
  Nanoseconds stamp_offset{0};             // of the kernel's times; vivid rounds them up
  std::map<IoctlCode, int> errors;         // of the next such request, once
  std::uint32_t capabilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
  bool is_gone = false;
  bool is_silent = false;
  bool may_not_open = false;
  std::uint32_t buffer_limit = 32;
  std::uint32_t colorspace = V4L2_COLORSPACE_SRGB;
  std::uint32_t quantization = V4L2_QUANTIZATION_DEFAULT;
  std::uint32_t granted_rate_per_s = 0;  // whatever is asked for; 0: what is

  int opened = 0;
  int open_now = 0;
  int mapped_now = 0;
  int frame_count = 0;                    // produced, lost ones too
  std::vector<Instant> begun_at;          // when the first bytes of each came
  std::vector<std::string> set_controls;  // "id=value"
};

std::unique_ptr<VideoDevice> make_fake_video_device(FakeCamera& camera);

// Bytes of a frame in this mode.
std::size_t fake_frame_bytes(const FakeMode& mode);

}  // namespace traygauge
