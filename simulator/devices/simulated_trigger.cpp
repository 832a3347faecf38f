#include "simulator/devices/simulated_trigger.hpp"

#include <algorithm>
#include <utility>

namespace traygauge {

SimulatedTrigger::SimulatedTrigger(Clock& clock, std::vector<Instant> presses)
    : Trigger("simulated button"), clock_(clock), schedule_(std::move(presses)), count_(schedule_.size()) {
  std::sort(schedule_.begin(), schedule_.end());
}

SimulatedTrigger::SimulatedTrigger(Clock& clock, const SimulatedIndicator& lamp, std::uint64_t count,
                                   Nanoseconds delay)
    : Trigger("simulated button"), clock_(clock), lamp_(&lamp), delay_(delay), count_(count) {}

void SimulatedTrigger::add_press(Instant at) {
  const auto next = schedule_.begin() + static_cast<std::ptrdiff_t>(pressed_);
  schedule_.insert(std::upper_bound(next, schedule_.end(), at), at);
  ++count_;
}

DeviceStatus SimulatedTrigger::do_wait_for_press(Nanoseconds timeout, Press& press) {
  const DeviceStatus fault = faults_.next();
  if (!fault.ok()) return fault;
  if (all_pressed()) return DeviceCode::ended;
  Instant at;
  if (!next_press(at) || at > clock_.now() + timeout) {
    clock_.sleep_for(timeout);
    return DeviceCode::timed_out;
  }
  clock_.sleep_until(at);
  press = {at, ++pressed_};
  if (before_press_) before_press_();
  return DeviceCode::ok;
}

int SimulatedTrigger::do_pending() const {
  int pending = 0;
  for (std::uint64_t i = pressed_; i < schedule_.size() && schedule_[i] <= clock_.now(); ++i) ++pending;
  return pending;
}

void SimulatedTrigger::do_discard_pending() {
  pressed_ += static_cast<std::uint64_t>(do_pending());
}

bool SimulatedTrigger::next_press(Instant& at) const {
  if (lamp_ == nullptr) {
    at = schedule_[pressed_];
    return true;
  }
  if (lamp_->shown() != Signal::ready) return false;
  at = std::max(clock_.now(), lamp_->history().back().since + delay_);
  return true;
}

}  // namespace traygauge
