// The rotating arm that carries the camera from the first view to the second. Angles are about the arm's
// axis by the right hand, in degrees, 0 at home.
#pragma once

#include "drivers/clock.hpp"
#include "drivers/device.hpp"
#include "drivers/device_status.hpp"

namespace traygauge {

struct ArmLimits {
  double min_deg = 0.0;
  double max_deg = 0.0;

  constexpr bool contains(double angle_deg) const { return angle_deg >= min_deg && angle_deg <= max_deg; }
};

class Arm : public Device {
 public:
  // Opens the motor; nothing moves. Starting twice is no error.
  DeviceStatus start();
  // Stops the motor where it is and closes it; after start() it has to go home again.
  void stop();
  bool is_started() const { return started_; }
  bool is_homed() const { return homed_; }
  ArmLimits limits() const { return do_limits(); }

  // Blocks until the arm stands still at 0, at most `timeout` (> 0). Before anything else, and again after
  // `stalled` or `timed_out`, because the arm then no longer knows where it stands.
  DeviceStatus home(Nanoseconds timeout);
  // Returns at once, the arm moves on. out_of_range beyond the limits, not_homed before home().
  DeviceStatus begin_move_to(double angle_deg);
  // Blocks until the arm stands still and no longer swings, at most `timeout` (> 0).
  DeviceStatus wait_until_still(Nanoseconds timeout);
  DeviceStatus move_to(double angle_deg, Nanoseconds timeout);
  // Where it is now, also while it moves.
  DeviceStatus read_position(double& angle_deg);

 protected:
  using Device::Device;

 private:
  virtual DeviceStatus do_start() = 0;
  virtual void do_stop() = 0;
  virtual ArmLimits do_limits() const = 0;
  virtual DeviceStatus do_home(Nanoseconds timeout) = 0;
  virtual DeviceStatus do_begin_move_to(double angle_deg) = 0;
  virtual DeviceStatus do_wait_until_still(Nanoseconds timeout) = 0;
  virtual DeviceStatus do_read_position(double& angle_deg) = 0;

  bool started_ = false;
  bool homed_ = false;
};

}  // namespace traygauge
