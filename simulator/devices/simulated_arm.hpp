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

// It counts its steps: one that is lost shifts every place after it, until it goes home to its switch.
class SimulatedArm final : public Arm {
 public:
  // With `player`, a move away from home ends at the angle that was recorded, where there is one; the
  // position says so. Without, at the commanded angle. Both outlive the arm.
  explicit SimulatedArm(Clock& clock, const TrayPlayer* player = nullptr,
                        const SimulatedArmParams& params = {});

  // Kinds stuck, wrong_angle, silent_stall and slow are asked once a begin_move_to, stall once a
  // wait_until_still and home, off and reports once each of these. A fault while it waits stops the arm half
  // way.
  FaultScript& faults() { return faults_; }
  // Where it is, whatever it knows of itself.
  double true_position_deg() const { return at_now().counted_deg + at_now().lost_deg; }
  // Where it was last sent away from home; 0 before.
  double aimed_deg() const { return aimed_deg_; }

 private:
  struct Place {
    double counted_deg = 0.0;  // where it thinks it is
    double lost_deg = 0.0;     // from there to where it is
  };

  DeviceStatus do_start() override { return faults_.next_start(clock_.now()); }
  void do_stop() override { halt(); }
  ArmLimits do_limits() const override { return params_.limits; }
  DeviceStatus do_home(Nanoseconds timeout) override;
  DeviceStatus do_begin_move_to(double angle_deg) override;
  DeviceStatus do_wait_until_still(Nanoseconds timeout) override;
  DeviceStatus do_read_position(double& angle_deg) override;

  Place at_now() const;
  void begin_motion(const Place& target, double slowness);
  void halt();
  Instant still_at() const { return arrives_at_ + params_.settling_time; }

  Clock& clock_;
  const TrayPlayer* player_;
  SimulatedArmParams params_;
  FaultScript faults_;
  Place from_;
  Place to_;
  double aimed_deg_ = 0.0;
  Instant left_at_;
  Instant arrives_at_;
};

}  // namespace traygauge
