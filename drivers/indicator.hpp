// The lamp that tells the diner what to do.
#pragma once

#include <cstddef>
#include <cstdint>

#include "drivers/device.hpp"
#include "drivers/device_status.hpp"

namespace traygauge {

enum class Signal : std::uint8_t {
  off,
  ready,       // press the button
  hold_still,  // pictures are being taken
  busy,        // the tray may be moved, the result is being computed
  done,
  try_again,   // this scan failed, the next may work
  move_on,     // the camera or the tray has not been moved far enough for the second view
  far_enough,  // it has: hold still and press
  too_far,     // it has been moved too far: back a little
  fault,       // the station needs somebody
};

inline constexpr std::size_t kSignalCount = static_cast<std::size_t>(Signal::fault) + 1;

// As logs spell it, e.g. "hold_still".
const char* name(Signal signal);

class Indicator : public Device {
 public:
  // Opens the lamp, which is then off. Starting twice is no error.
  DeviceStatus start();
  // Off, and closed.
  void stop();
  bool is_started() const { return started_; }

  // Shows `signal` until the next one; does not block. The same signal again does nothing.
  DeviceStatus show(Signal signal);
  Signal shown() const { return shown_; }

 protected:
  using Device::Device;

 private:
  virtual DeviceStatus do_start() = 0;
  virtual void do_stop() = 0;
  virtual DeviceStatus do_show(Signal signal) = 0;

  bool started_ = false;
  Signal shown_ = Signal::off;
};

}  // namespace traygauge
