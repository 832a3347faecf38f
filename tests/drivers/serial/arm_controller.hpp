// The other end of a serial arm's line: a pseudo-terminal with a small controller behind it.
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace traygauge {

// Answers on a thread of its own. 18 degrees take a fifth of a second.
class ArmController {
 public:
  static constexpr double kSpeed_deg_per_s = 90.0;

  ArmController() {
    master_ = posix_openpt(O_RDWR | O_NOCTTY);
    grantpt(master_);
    unlockpt(master_);
    path_ = ptsname(master_);
    // A pseudo-terminal without a reader hangs up; a serial line does not.
    slave_ = ::open(path_.c_str(), O_RDWR | O_NOCTTY);
    termios raw{};
    tcgetattr(slave_, &raw);
    cfmakeraw(&raw);
    tcsetattr(slave_, TCSANOW, &raw);
    thread_ = std::thread([this] { serve(); });
  }
  ~ArmController() { unplug(); }

  void unplug() {
    ends_ = true;
    if (thread_.joinable()) thread_.join();
    if (master_ >= 0) ::close(master_);
    if (slave_ >= 0) ::close(slave_);
    master_ = slave_ = -1;
  }
  const std::string& path() const { return path_; }
  // Instead of the usual answer to a request; nothing: silence.
  using Answer = std::function<std::optional<std::string>(const std::string& request)>;
  void answer_with(Answer answer) {
    const std::lock_guard lock(mutex_);
    answer_ = std::move(answer);
  }
  // Where the arm stands.
  double position_deg() {
    const std::lock_guard lock(mutex_);
    return angle_deg();
  }
  std::atomic<bool> stalls = false;

 private:
  using Time = std::chrono::steady_clock;

  void serve() {
    std::string received;
    while (!ends_) {
      pollfd watched{master_, POLLIN, 0};
      if (::poll(&watched, 1, 10) <= 0) continue;
      char byte = 0;
      if (::read(master_, &byte, 1) != 1) continue;
      if (byte != '\n') {
        received += byte;
        continue;
      }
      if (const auto reply = answer(received)) {
        const std::string text = *reply + "\r\n";
        if (::write(master_, text.data(), text.size()) < 0) return;
      }
      received.clear();
    }
  }

  std::optional<std::string> answer(const std::string& request) {
    const std::lock_guard lock(mutex_);
    if (answer_) return answer_(request);
    return usual_answer(request);
  }

  std::optional<std::string> usual_answer(const std::string& request) {
    if (request == "HELLO") return "TRAYGAUGE-ARM 1 -45 45";
    if (request == "HOME") return move_to(0.0);
    if (request == "HALT") return move_to(angle_deg());
    if (request == "WHERE") {
      char text[48];
      const bool is_moving = Time::now() < arrives_at_;
      std::snprintf(text, sizeof text, "AT %.3f %s", angle_deg(),
                    stalls      ? "STALLED"
                    : is_moving ? "MOVING"
                                : "STILL");
      return text;
    }
    double target_deg = 0.0;
    if (std::sscanf(request.c_str(), "MOVE %lf", &target_deg) == 1) return move_to(target_deg);
    return "ERROR unknown request";
  }

  std::string move_to(double target_deg) {
    from_deg_ = angle_deg();
    to_deg_ = target_deg;
    left_at_ = Time::now();
    arrives_at_ = left_at_ + std::chrono::microseconds(
                                 std::llround(1e6 * std::abs(to_deg_ - from_deg_) / kSpeed_deg_per_s));
    return "OK";
  }
  double angle_deg() const {
    const auto now = Time::now();
    if (now >= arrives_at_) return to_deg_;
    const double share = std::chrono::duration<double>(now - left_at_) / (arrives_at_ - left_at_);
    return from_deg_ + share * (to_deg_ - from_deg_);
  }

  int master_ = -1;
  int slave_ = -1;
  std::string path_;
  std::atomic<bool> ends_ = false;
  std::mutex mutex_;
  Answer answer_;
  double from_deg_ = 12.0;
  double to_deg_ = 12.0;
  Time::time_point left_at_;
  Time::time_point arrives_at_;
  std::thread thread_;
};

}  // namespace traygauge
