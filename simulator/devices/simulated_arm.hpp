// An arm that moves in simulated time and stops where the tray's second view was recorded.
#pragma once

#include <chrono>

#include "drivers/arm.hpp"
#include "simulator/devices/fault_script.hpp"
#include "simulator/devices/tray_player.hpp"

namespace traygauge {

// Defaults: a small geared stepper.
struct SimulatedArmParams {
  ArmLimits limits{-45.0, 45.0};
  double speed_deg_per_s = 30.0;
  Nanoseconds settling_time = std::chrono::milliseconds(300);  // until it no longer swings
  double power_on_deg = 12.0;                                  // where it hangs before it has gone home
};

class SimulatedArm final : public Arm {
 public:
  // With `player`, a move away from home ends at the angle that was recorded, where there is one; the
  // position says so. Without, at the commanded angle. Both outlive the arm.
  explicit SimulatedArm(Clock& clock, const TrayPlayer* player = nullptr,
                        const SimulatedArmParams& params = {});

  // Asked once a home, begin_move_to and wait_until_still. A fault while it waits stops the arm half way.
  FaultScript& faults() { return faults_; }
  // Where it is, whatever it knows of itself.
  double true_position_deg() const;

 private:
  DeviceStatus do_start() override;
  void do_stop() override;
  ArmLimits do_limits() const override { return params_.limits; }
  DeviceStatus do_home(Nanoseconds timeout) override;
  DeviceStatus do_begin_move_to(double angle_deg) override;
  DeviceStatus do_wait_until_still(Nanoseconds timeout) override;
  DeviceStatus do_read_position(double& angle_deg) override;

  void begin_motion(double target_deg);
  void halt();
  Instant still_at() const { return arrives_at_ + params_.settling_time; }

  Clock& clock_;
  const TrayPlayer* player_;
  SimulatedArmParams params_;
  FaultScript faults_;
  double from_deg_;
  double to_deg_;
  Instant left_at_;
  Instant arrives_at_;
};

}  // namespace traygauge
