// The button that starts a scan.
#pragma once

#include <cstdint>

#include "drivers/clock.hpp"
#include "drivers/device.hpp"
#include "drivers/device_status.hpp"

namespace traygauge {

struct Press {
  Instant at;
  std::uint64_t sequence = 0;  // counts presses since start(), from 1
};

class Trigger : public Device {
 public:
  // Opens the button. Starting twice is no error.
  DeviceStatus start();
  void stop();
  bool is_started() const { return started_; }

  // Blocks until a press, at most `timeout` (> 0): ok, timed_out, or ended when no press will ever come.
  // Presses that came meanwhile wait in a queue and are delivered first, in order. One call, one press.
  DeviceStatus wait_for_press(Nanoseconds timeout, Press& press);
  // Blocks until the button is open, at most `timeout` (> 0): ok, or timed_out while it stays pressed.
  DeviceStatus wait_for_release(Nanoseconds timeout);
  // Presses that wait; does not block.
  int pending() { return started_ ? do_pending() : 0; }
  // Forgets the presses that wait, e.g. those during a scan.
  void discard_pending();

 protected:
  using Device::Device;

 private:
  virtual DeviceStatus do_start() = 0;
  virtual void do_stop() = 0;
  virtual DeviceStatus do_wait_for_press(Nanoseconds timeout, Press& press) = 0;
  virtual DeviceStatus do_wait_for_release(Nanoseconds timeout) = 0;
  virtual int do_pending() = 0;
  virtual void do_discard_pending() = 0;

  bool started_ = false;
};

}  // namespace traygauge
