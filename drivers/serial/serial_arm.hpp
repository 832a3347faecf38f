// An arm with a controller of its own on a serial line. The protocol is text, a line each way; see
// drivers/README.md.
#pragma once

#include <string>

#include "drivers/arm.hpp"
#include "drivers/serial/serial_port.hpp"

namespace traygauge {

struct SerialArmParams {
  std::string device = "/dev/serial/by-id/arm";
  double tolerance_deg = 0.5;  // where it stands against where it was sent; beyond, scans are refused
  int baud = 115200;
  Nanoseconds reply_timeout = std::chrono::milliseconds(500);
  // Many controllers start anew when the line is opened, which takes a second or two.
  Nanoseconds boot_timeout = std::chrono::seconds(4);
  Nanoseconds longest_move = std::chrono::seconds(30);  // home from anywhere included
  Nanoseconds settling_time = std::chrono::milliseconds(300);
};

class SerialArm final : public Arm {
 public:
  // `clock` is the system's; it outlives the arm.
  SerialArm(Clock& clock, const SerialArmParams& params);
  ~SerialArm() override { stop(); }

 private:
  struct Report {
    double angle_deg = 0.0;
    std::string state;
  };

  DeviceStatus do_start() override;
  void do_stop() override;
  ArmLimits do_limits() const override { return limits_; }
  DeviceStatus do_home(Nanoseconds timeout) override;
  DeviceStatus do_begin_move_to(double angle_deg) override;
  DeviceStatus do_wait_until_still(Nanoseconds timeout) override;
  DeviceStatus do_read_position(double& angle_deg) override;

  DeviceStatus greet();
  DeviceStatus ask(const std::string& request, std::string& reply);
  DeviceStatus command(const std::string& request);
  DeviceStatus read_report(Report& report);
  DeviceStatus refuse(const std::string& request, const std::string& reply);

  Clock& clock_;
  SerialArmParams params_;
  SerialPort port_;
  ArmLimits limits_;         // as the controller says
  double target_deg_ = 0.0;  // where it was last sent
};

}  // namespace traygauge
