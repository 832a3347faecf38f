#include "drivers/serial/serial_arm.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <sstream>

namespace traygauge {
namespace {

constexpr const char* kGreeting = "TRAYGAUGE-ARM";
constexpr int kProtocol = 1;
constexpr Nanoseconds kPollInterval = std::chrono::milliseconds(20);
constexpr double kWidestLimit_deg = 360.0;

}  // namespace

SerialArm::SerialArm(Clock& clock, const SerialArmParams& params)
    : Arm("arm " + params.device), clock_(clock), params_(params) {}

DeviceStatus SerialArm::refuse(const std::string& request, const std::string& reply) {
  set_detail("asked \"" + request + "\", it says \"" + reply + "\"");
  return DeviceCode::io_error;
}

DeviceStatus SerialArm::do_start() {
  set_detail({});
  DeviceStatus status = port_.open(params_.device, params_.baud);
  if (status.ok()) status = greet();
  if (!status.ok()) port_.close();
  return status;
}

void SerialArm::do_stop() {
  std::string reply;
  static_cast<void>(ask("HALT", reply));  // a controller that has gone cannot be stopped
  port_.close();
}

// A controller that is still starting answers nothing, or half a line.
DeviceStatus SerialArm::greet() {
  const Instant deadline = clock_.now() + params_.boot_timeout;
  std::string reply;
  DeviceStatus status = DeviceCode::timed_out;
  while (clock_.now() < deadline) {
    status = ask("HELLO", reply);
    if (status.code() == DeviceCode::device_gone) return status;
    if (!status.ok()) continue;
    std::istringstream words(reply);
    std::string greeting;
    int protocol = 0;
    words >> greeting >> protocol >> limits_.min_deg >> limits_.max_deg;
    if (greeting != kGreeting) {
      clock_.sleep_for(kPollInterval);
      status = refuse("HELLO", reply);
      continue;
    }
    const bool is_usable = words && limits_.min_deg <= 0.0 && limits_.max_deg > 0.0 &&
                           limits_.min_deg >= -kWidestLimit_deg && limits_.max_deg <= kWidestLimit_deg;
    if (protocol == kProtocol && is_usable) return DeviceCode::ok;
    static_cast<void>(refuse("HELLO", reply));
    return DeviceCode::unsupported;
  }
  return status;
}

// What arrived before the request is the answer to an earlier one.
DeviceStatus SerialArm::ask(const std::string& request, std::string& reply) {
  port_.discard();
  DeviceStatus status = port_.send(request, params_.reply_timeout);
  if (status.ok()) status = port_.receive(reply, params_.reply_timeout);
  return status;
}

DeviceStatus SerialArm::command(const std::string& request) {
  std::string reply;
  const DeviceStatus status = ask(request, reply);
  if (!status.ok()) return status;
  return reply == "OK" ? DeviceStatus() : refuse(request, reply);
}

DeviceStatus SerialArm::read_report(Report& report) {
  std::string reply;
  const DeviceStatus status = ask("WHERE", reply);
  if (!status.ok()) return status;
  std::istringstream words(reply);
  std::string at;
  words >> at >> report.angle_deg >> report.state;
  if (!words || at != "AT") return refuse("WHERE", reply);
  return DeviceCode::ok;
}

DeviceStatus SerialArm::do_home(Nanoseconds timeout) {
  target_deg_ = 0.0;
  const DeviceStatus status = command("HOME");
  return status.ok() ? do_wait_until_still(timeout) : status;
}

DeviceStatus SerialArm::do_begin_move_to(double angle_deg) {
  Report report;
  if (const DeviceStatus status = read_report(report); !status.ok()) return status;
  if (report.state == "MOVING") return DeviceCode::busy;
  target_deg_ = angle_deg;
  std::array<char, 48> request{};
  std::snprintf(request.data(), request.size(), "MOVE %.3f", angle_deg);
  return command(request.data());
}

DeviceStatus SerialArm::do_wait_until_still(Nanoseconds timeout) {
  const Instant deadline = clock_.now() + timeout;
  while (true) {
    Report report;
    const DeviceStatus status = read_report(report);
    if (!status.ok()) return status;
    if (report.state == "STALLED" || report.state == "LOST") {
      set_detail("it says " + report.state);
      return DeviceCode::stalled;
    }
    const bool is_still = report.state == "STILL";
    if (!is_still && report.state != "MOVING") return refuse("WHERE", report.state);
    if (is_still && std::abs(report.angle_deg - target_deg_) > params_.tolerance_deg) {
      std::array<char, 80> text{};
      std::snprintf(text.data(), text.size(), "it stands still at %.2f degrees, sent to %.2f",
                    report.angle_deg, target_deg_);
      set_detail(text.data());
      return DeviceCode::stalled;
    }
    if (is_still && clock_.now() + params_.settling_time <= deadline) {
      clock_.sleep_for(params_.settling_time);
      return DeviceCode::ok;
    }
    if (is_still || clock_.now() + kPollInterval > deadline) {
      static_cast<void>(command("HALT"));
      return DeviceCode::timed_out;
    }
    clock_.sleep_for(kPollInterval);
  }
}

DeviceStatus SerialArm::do_read_position(double& angle_deg) {
  Report report;
  const DeviceStatus status = read_report(report);
  angle_deg = report.angle_deg;
  return status;
}

}  // namespace traygauge
