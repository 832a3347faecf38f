#include "drivers/v4l2/video_device.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <ctime>

namespace traygauge {
namespace {

class SystemVideoDevice final : public VideoDevice {
 public:
  SystemVideoDevice() = default;
  ~SystemVideoDevice() override { SystemVideoDevice::close(); }

  int open(const std::string& path) override {
    descriptor_ = ::open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
    return descriptor_ < 0 ? errno : 0;
  }

  void close() override {
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = -1;
  }

  int request(IoctlCode code, void* argument) override {
    int result = 0;
    do {
      result = ::ioctl(descriptor_, code, argument);
    } while (result < 0 && errno == EINTR);
    return result < 0 ? errno : 0;
  }

  std::span<std::uint8_t> map(std::size_t length, std::uint32_t offset) override {
    void* const memory = ::mmap(nullptr, length, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor_, offset);
    if (memory == MAP_FAILED) return {};
    return {static_cast<std::uint8_t*>(memory), length};
  }

  void unmap(std::span<std::uint8_t> buffer) override { ::munmap(buffer.data(), buffer.size()); }

  // A signal ends the wait early, as if nothing had come: the caller looks at the time.
  int wait(Nanoseconds timeout, bool& has_news) override {
    pollfd watched{descriptor_, POLLIN, 0};
    const auto seconds = std::chrono::floor<std::chrono::seconds>(std::max(timeout, Nanoseconds::zero()));
    timespec time{};
    time.tv_sec = static_cast<time_t>(seconds.count());
    time.tv_nsec =
        static_cast<decltype(time.tv_nsec)>((std::max(timeout, Nanoseconds::zero()) - seconds).count());
    const int count = ::ppoll(&watched, 1, &time, nullptr);
    has_news = count > 0;
    return count < 0 && errno != EINTR ? errno : 0;
  }

 private:
  int descriptor_ = -1;
};

}  // namespace

std::unique_ptr<VideoDevice> make_system_video_device() {
  return std::make_unique<SystemVideoDevice>();
}

}  // namespace traygauge
