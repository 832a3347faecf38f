#include "drivers/trigger.hpp"

namespace traygauge {

DeviceStatus Trigger::start() {
  if (started_) return DeviceCode::ok;
  const DeviceStatus status = do_start();
  started_ = status.ok();
  return status;
}

void Trigger::stop() {
  if (started_) do_stop();
  started_ = false;
}

DeviceStatus Trigger::wait_for_press(Nanoseconds timeout, Press& press) {
  press = {};
  if (!started_) return DeviceCode::not_started;
  if (timeout <= Nanoseconds::zero()) return DeviceCode::invalid_argument;
  return do_wait_for_press(timeout, press);
}

DeviceStatus Trigger::wait_for_release(Nanoseconds timeout) {
  if (!started_) return DeviceCode::not_started;
  if (timeout <= Nanoseconds::zero()) return DeviceCode::invalid_argument;
  return do_wait_for_release(timeout);
}

void Trigger::discard_pending() {
  if (started_) do_discard_pending();
}

}  // namespace traygauge
