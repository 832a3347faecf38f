// A camera's buffers in the kernel: a fixed number, mapped at the start, none taken later.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "drivers/device_status.hpp"
#include "drivers/v4l2/video_device.hpp"

namespace traygauge {

// A frame that the kernel has filled. It is ours until it is given back.
struct FilledBuffer {
  std::uint32_t index = 0;
  std::span<const std::uint8_t> bytes;
  std::uint32_t sequence = 0;
  std::optional<Instant> stamped_at;  // by the kernel's monotonic clock, where it says so
  bool is_stamped_at_start = false;   // of the frame; else when it was complete
  bool is_damaged = false;            // the kernel says so
};

class VideoStream {
 public:
  explicit VideoStream(VideoDevice& device) : device_(device) {}
  VideoStream(const VideoStream&) = delete;
  VideoStream& operator=(const VideoStream&) = delete;
  ~VideoStream() { stop(); }

  // Maps about `count` buffers (the driver may take more or fewer) and begins to stream. After a failure
  // nothing is held.
  DeviceStatus start(int count);
  // Ends streaming and gives every buffer back; also where the device has gone.
  void stop();
  int buffer_count() const { return static_cast<int>(buffers_.size()); }

  // A filled buffer, waiting at most `timeout`: timed_out when there was none, which may be earlier.
  DeviceStatus take(Nanoseconds timeout, FilledBuffer& filled);
  DeviceStatus give_back(const FilledBuffer& buffer);

 private:
  DeviceStatus map_buffers(int count);
  DeviceStatus queue(std::uint32_t index);
  // Nothing for a stamp of zero, or one that does not move: some drivers say that they stamp frames, and do
  // not.
  std::optional<Instant> believe(Instant stamp);

  VideoDevice& device_;
  std::vector<std::span<std::uint8_t>> buffers_;
  bool is_streaming_ = false;
  std::optional<Instant> last_stamp_;  // believed, since the start
};

}  // namespace traygauge
