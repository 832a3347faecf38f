// A small model of the kernel behind a camera: buffers, controls and frames in simulated time, with faults.
// It counts what is held, and fails the test on requests that the kernel would punish.
#pragma once

#include <linux/videodev2.h>

#include <deque>
#include <map>
#include <set>
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
};

struct FakeControl {
  int minimum = 0;
  int maximum = 100;
  int step = 1;
  int value = 0;
  bool is_stubborn = false;  // takes a value and keeps its own
};

// What is special about the frames from one on, by their number since the camera was made.
struct FakeFrame {
  std::uint32_t flags = 0;
  double length_share = 1.0;
  bool is_lost = false;
};

// What the camera sees, and everything that survives a replug. Outlives the devices.
struct FakeCamera {
  explicit FakeCamera(SimulatedClock& clock_) : clock(clock_) {}

  SimulatedClock& clock;
  std::string node = "/dev/video7";
  std::vector<FakeMode> modes = {FakeMode{}};
  std::map<std::uint32_t, FakeControl> controls;
  std::map<int, FakeFrame> frames;                    // those with something special
  std::map<int, std::vector<std::uint8_t>> pictures;  // from this frame on, instead of noise
  std::uint32_t stamp_flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC | V4L2_BUF_FLAG_TSTAMP_SRC_SOE;
  Nanoseconds stamp_offset{0};          // of the kernel's times; vivid rounds them up
  std::map<unsigned long, int> errors;  // of the next such request, once
  bool is_gone = false;
  bool is_silent = false;
  bool may_not_open = false;
  std::uint32_t buffer_limit = 32;

  int opened = 0;
  int open_now = 0;
  int mapped_now = 0;
  int frame_count = 0;                    // produced, lost ones too
  std::vector<std::string> set_controls;  // "id=value"
};

class FakeVideoDevice final : public VideoDevice {
 public:
  explicit FakeVideoDevice(FakeCamera& camera) : camera_(camera) {}
  ~FakeVideoDevice() override { FakeVideoDevice::close(); }

  int open(const std::string& path) override;
  void close() override;
  int request(unsigned long code, void* argument) override;
  std::span<std::uint8_t> map(std::size_t length, std::uint32_t offset) override;
  void unmap(std::span<std::uint8_t> buffer) override;
  int wait(Nanoseconds timeout, bool& has_news) override;

 private:
  struct Filled {
    std::uint32_t index;
    std::size_t length;
    std::uint32_t sequence;
    std::uint32_t flags;
    Instant stamped_at;
  };

  int enumerate_format(v4l2_fmtdesc& entry) const;
  int enumerate_size(v4l2_frmsizeenum& entry) const;
  int enumerate_rate(v4l2_frmivalenum& entry) const;
  int set_format(v4l2_format& format);
  int request_buffers(v4l2_requestbuffers& request);
  int query_control(v4l2_queryctrl& query) const;
  int write_control(const v4l2_control& control);
  int queue(const v4l2_buffer& buffer);
  int dequeue(v4l2_buffer& buffer);
  void produce_until(Instant instant);
  void fill(int number, Instant begun_at);

  FakeCamera& camera_;
  bool is_open_ = false;
  bool is_streaming_ = false;
  FakeMode mode_;
  std::vector<std::vector<std::uint8_t>> buffers_;
  std::deque<std::uint32_t> queued_;
  std::deque<Filled> filled_;
  std::set<const std::uint8_t*> mapped_;
  Instant next_frame_at_;
};

// Bytes of a frame in this mode.
std::size_t fake_frame_bytes(const FakeMode& mode);

}  // namespace traygauge
