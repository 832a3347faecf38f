// The system calls behind a camera, as an interface: tests stand in for the kernel.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "drivers/clock.hpp"

namespace traygauge {

using IoctlCode = unsigned long;  // NOLINT(google-runtime-int): the type that ioctl itself takes

// Errors are errno values, 0 where there was none. Interrupted calls are repeated.
class VideoDevice {
 public:
  VideoDevice() = default;
  VideoDevice(const VideoDevice&) = delete;
  VideoDevice& operator=(const VideoDevice&) = delete;
  virtual ~VideoDevice() = default;

  // For reading and writing, without ever blocking. It is closed.
  virtual int open(const std::string& path) = 0;
  virtual void close() = 0;
  // An ioctl.
  virtual int request(IoctlCode code, void* argument) = 0;
  // A buffer of the kernel; empty when it could not be mapped.
  virtual std::span<std::uint8_t> map(std::size_t length, std::uint32_t offset) = 0;
  virtual void unmap(std::span<std::uint8_t> buffer) = 0;
  // Until a frame waits or something is wrong (`has_news`), at most `timeout`.
  virtual int wait(Nanoseconds timeout, bool& has_news) = 0;
};

// The kernel itself.
std::unique_ptr<VideoDevice> make_system_video_device();

}  // namespace traygauge
