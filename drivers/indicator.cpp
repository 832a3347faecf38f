#include "drivers/indicator.hpp"

#include <array>
#include <cstddef>

namespace traygauge {

const char* name(Signal signal) {
  static constexpr auto kNames =
      std::to_array<const char*>({"off", "ready", "hold_still", "busy", "done", "try_again", "move_on",
                                  "far_enough", "too_far", "fault"});
  static_assert(kNames.size() == static_cast<std::size_t>(Signal::fault) + 1);
  return kNames[static_cast<std::size_t>(signal)];
}

DeviceStatus Indicator::start() {
  if (started_) return DeviceCode::ok;
  const DeviceStatus status = do_start();
  started_ = status.ok();
  shown_ = Signal::off;
  return status;
}

void Indicator::stop() {
  if (started_) do_stop();
  started_ = false;
  shown_ = Signal::off;
}

DeviceStatus Indicator::show(Signal signal) {
  if (!started_) return DeviceCode::not_started;
  if (signal > Signal::fault) return DeviceCode::invalid_argument;
  if (signal == shown_) return DeviceCode::ok;
  const DeviceStatus status = do_show(signal);
  if (status.ok()) shown_ = signal;
  return status;
}

}  // namespace traygauge
