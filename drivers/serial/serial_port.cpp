#include "drivers/serial/serial_port.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <optional>
#include <utility>

namespace traygauge {
namespace {

constexpr std::size_t kMaxLine = 200;

constexpr auto kSpeeds = std::to_array<std::pair<int, speed_t>>(
    {{9600, B9600}, {19200, B19200}, {38400, B38400}, {57600, B57600}, {115200, B115200}, {230400, B230400}});

std::optional<speed_t> find_speed(int baud) {
  const auto* const speed =
      std::find_if(kSpeeds.begin(), kSpeeds.end(), [baud](const auto& known) { return known.first == baud; });
  return speed != kSpeeds.end() ? std::optional(speed->second) : std::nullopt;
}

// A line whose other end was pulled out says EIO.
DeviceStatus status_of_failure(int error_number) {
  return error_number == EIO ? DeviceStatus(DeviceCode::device_gone, EIO) : status_of_errno(error_number);
}

// Two programs on one line read each other's answers. The lock is for those that ask for it, and the other
// for those that do not; neither alone stops both a second station of root's and a terminal program.
int take_alone(int descriptor) {
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) return errno == EWOULDBLOCK ? EBUSY : errno;
  return ::ioctl(descriptor, TIOCEXCL) != 0 && errno != ENOTTY ? errno : 0;
}

int configure(int descriptor, speed_t speed) {
  termios settings{};
  if (tcgetattr(descriptor, &settings) != 0) return errno;
  cfmakeraw(&settings);
  settings.c_cflag |= CLOCAL | CREAD;
  settings.c_cflag &= ~static_cast<tcflag_t>(CSTOPB | CRTSCTS);
  if (cfsetispeed(&settings, speed) != 0 || cfsetospeed(&settings, speed) != 0) return errno;
  if (tcsetattr(descriptor, TCSANOW, &settings) != 0) return errno;
  return tcflush(descriptor, TCIOFLUSH) != 0 ? errno : 0;
}

}  // namespace

bool is_serial_speed(int baud) {
  return find_speed(baud).has_value();
}

DeviceStatus SerialPort::open(const std::string& path, int baud) {
  close();
  const std::optional<speed_t> speed = find_speed(baud);
  if (!speed) return DeviceCode::invalid_argument;
  descriptor_ = ::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor_ < 0) return status_of_errno(errno);
  if (const int error = take_alone(descriptor_); error != 0) {
    ::close(descriptor_);
    descriptor_ = -1;
    return status_of_errno(error);
  }
  if (const int error = configure(descriptor_, *speed); error != 0) {
    close();
    return error == ENOTTY ? DeviceStatus(DeviceCode::unsupported, error) : status_of_errno(error);
  }
  return DeviceCode::ok;
}

void SerialPort::close() {
  if (descriptor_ >= 0) {
    ::ioctl(descriptor_, TIOCNXCL);
    ::close(descriptor_);
  }
  descriptor_ = -1;
  received_.clear();
}

void SerialPort::discard() {
  tcflush(descriptor_, TCIFLUSH);
  received_.clear();
}

DeviceStatus SerialPort::wait(std::int16_t events, Instant deadline) {
  while (true) {
    const Nanoseconds left = deadline - clock_.now();
    if (left <= Nanoseconds::zero()) return DeviceCode::timed_out;
    pollfd watched{descriptor_, events, 0};
    const std::int64_t left_ms = std::chrono::ceil<std::chrono::milliseconds>(left).count();
    const int count = ::poll(&watched, 1, static_cast<int>(std::min<std::int64_t>(left_ms, 1000)));
    if (count < 0 && errno != EINTR) return status_of_errno(errno);
    if (count <= 0) continue;
    if ((watched.revents & events) != 0) return DeviceCode::ok;
    return status_of_failure(EIO);
  }
}

DeviceStatus SerialPort::send(std::string_view line, Nanoseconds timeout) {
  const Instant deadline = clock_.now() + timeout;
  const std::string text = std::string(line) + "\n";
  std::size_t sent = 0;
  while (sent < text.size()) {
    if (const DeviceStatus status = wait(POLLOUT, deadline); !status.ok()) return status;
    const ssize_t count = ::write(descriptor_, text.data() + sent, text.size() - sent);
    if (count < 0 && errno != EAGAIN && errno != EINTR) return status_of_failure(errno);
    if (count > 0) sent += static_cast<std::size_t>(count);
  }
  return DeviceCode::ok;
}

DeviceStatus SerialPort::receive(std::string& line, Nanoseconds timeout) {
  const Instant deadline = clock_.now() + timeout;
  while (true) {
    if (const std::size_t end = received_.find('\n'); end != std::string::npos) {
      line = received_.substr(0, end);
      received_.erase(0, end + 1);
      if (!line.empty() && line.back() == '\r') line.pop_back();
      return DeviceCode::ok;
    }
    if (received_.size() > kMaxLine) {
      received_.clear();
      return DeviceCode::io_error;
    }
    if (const DeviceStatus status = wait(POLLIN, deadline); !status.ok()) return status;
    std::array<char, 64> bytes{};
    const ssize_t count = ::read(descriptor_, bytes.data(), bytes.size());
    if (count == 0) return status_of_failure(EIO);
    if (count < 0 && errno != EAGAIN && errno != EINTR) return status_of_failure(errno);
    if (count > 0) received_.append(bytes.data(), static_cast<std::size_t>(count));
  }
}

}  // namespace traygauge
