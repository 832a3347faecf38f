#include "simulator/devices/simulated_trigger.hpp"

#include <algorithm>
#include <utility>

namespace traygauge {
namespace {

constexpr Nanoseconds kBounceInterval = std::chrono::milliseconds(4);  // of a worn contact

}  // namespace

SimulatedTrigger::SimulatedTrigger(Clock& clock, std::vector<Instant> presses)
    : Trigger("simulated button"), clock_(clock), schedule_(std::move(presses)), count_(schedule_.size()) {
  std::sort(schedule_.begin(), schedule_.end());
}

SimulatedTrigger::SimulatedTrigger(Clock& clock, const SimulatedIndicator& lamp, std::uint64_t count,
                                   const PersonParams& person)
    : Trigger("simulated button"), clock_(clock), lamp_(&lamp), person_(person), count_(count) {}

void SimulatedTrigger::add_press(Instant at) {
  const auto next = schedule_.begin() + static_cast<std::ptrdiff_t>(pressed_);
  schedule_.insert(std::upper_bound(next, schedule_.end(), at), at);
  ++count_;
}

DeviceStatus SimulatedTrigger::do_wait_for_press(Nanoseconds timeout, Press& press) {
  const FaultAction fault = faults_.next(clock_.now(), set_of({FaultKind::off}));
  if (fault.code() != DeviceCode::ok) return fault.code();
  const Instant deadline = clock_.now() + timeout;
  while (edges_.empty() && !all_pressed() && next_press() <= deadline) press_at(next_press());
  if (edges_.empty() && all_pressed()) return DeviceCode::ended;
  if (edges_.empty() || edges_.front().seen_at > deadline) {
    clock_.sleep_until(deadline);
    return DeviceCode::timed_out;
  }
  const Edge edge = edges_.front();
  edges_.pop_front();
  clock_.sleep_until(edge.seen_at);
  press = {edge.at, ++sequence_};
  released_at_ = edge.at;
  if (edge.is_press && edge.at >= held_.after) released_at_ += std::exchange(held_, {}).held;
  if (edge.is_press && before_press_) before_press_();
  return DeviceCode::ok;
}

DeviceStatus SimulatedTrigger::do_wait_for_release(Nanoseconds timeout) {
  const Instant deadline = clock_.now() + timeout;
  clock_.sleep_until(std::min(released_at_, deadline));
  return released_at_ <= deadline ? DeviceCode::ok : DeviceCode::timed_out;
}

int SimulatedTrigger::do_pending() {
  const Instant now = clock_.now();
  int pending = static_cast<int>(
      std::count_if(edges_.begin(), edges_.end(), [now](const Edge& edge) { return edge.seen_at <= now; }));
  for (std::uint64_t i = pressed_; i < schedule_.size() && schedule_[i] <= now; ++i) ++pending;
  return pending;
}

void SimulatedTrigger::do_discard_pending() {
  const Instant now = clock_.now();
  std::erase_if(edges_, [this, now](const Edge& edge) {
    const bool is_forgotten = edge.seen_at <= now;
    if (is_forgotten && edge.is_press && lamp_ != nullptr) --pressed_;  // the person tries again
    return is_forgotten;
  });
  while (pressed_ < schedule_.size() && schedule_[pressed_] <= now) ++pressed_;
}

Instant SimulatedTrigger::next_press() const {
  if (lamp_ == nullptr) return schedule_[pressed_];
  const ShownSignal seen = lamp_->seen();
  const bool is_asked = seen.signal == Signal::ready || seen.signal == Signal::far_enough;
  const bool is_called = is_asked && seen.since + person_.delay > last_try_;
  return std::max(clock_.now(), is_called ? seen.since + person_.delay : last_try_ + person_.patience);
}

// A press that the contact loses was none for the station; the person notices, and tries again.
void SimulatedTrigger::press_at(Instant at) {
  const FaultAction fault = faults_.next(at, set_of({FaultKind::stuck, FaultKind::late, FaultKind::bounce}));
  last_try_ = at;
  const bool is_lost = fault.is(FaultKind::stuck);
  if (is_lost) ++tries_;
  if (!is_lost || lamp_ == nullptr) ++pressed_;
  if (is_lost) return;
  tries_ = 0;
  edges_.push_back({at, at + fault.delay(), true});
  if (!fault.is(FaultKind::bounce)) return;
  for (int i = 1; i < static_cast<int>(fault.amount); ++i) {
    const Instant bounced_at = at + i * kBounceInterval;
    edges_.push_back({bounced_at, bounced_at, false});
  }
}

}  // namespace traygauge
