#include "drivers/arm.hpp"

namespace traygauge {

DeviceStatus Arm::start() {
  if (started_) return DeviceCode::ok;
  const DeviceStatus status = do_start();
  started_ = status.ok();
  homed_ = false;
  return status;
}

void Arm::stop() {
  if (started_) do_stop();
  started_ = false;
  homed_ = false;
}

DeviceStatus Arm::home(Nanoseconds timeout) {
  if (!started_) return DeviceCode::not_started;
  if (timeout <= Nanoseconds::zero()) return DeviceCode::invalid_argument;
  const DeviceStatus status = do_home(timeout);
  homed_ = status.ok();
  return status;
}

DeviceStatus Arm::begin_move_to(double angle_deg) {
  if (!started_) return DeviceCode::not_started;
  if (!homed_) return DeviceCode::not_homed;
  if (!do_limits().contains(angle_deg)) return DeviceCode::out_of_range;  // NaN included
  return do_begin_move_to(angle_deg);
}

DeviceStatus Arm::wait_until_still(Nanoseconds timeout) {
  if (!started_) return DeviceCode::not_started;
  if (!homed_) return DeviceCode::not_homed;
  if (timeout <= Nanoseconds::zero()) return DeviceCode::invalid_argument;
  const DeviceStatus status = do_wait_until_still(timeout);
  if (!status.ok()) homed_ = false;
  return status;
}

DeviceStatus Arm::move_to(double angle_deg, Nanoseconds timeout) {
  if (timeout <= Nanoseconds::zero()) return DeviceCode::invalid_argument;
  const DeviceStatus status = begin_move_to(angle_deg);
  return status.ok() ? wait_until_still(timeout) : status;
}

DeviceStatus Arm::read_position(double& angle_deg) {
  if (!started_) return DeviceCode::not_started;
  if (!homed_) return DeviceCode::not_homed;
  return do_read_position(angle_deg);
}

}  // namespace traygauge
