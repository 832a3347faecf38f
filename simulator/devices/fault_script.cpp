#include "simulator/devices/fault_script.hpp"

namespace traygauge {

// A draw is spent on every call that counts, so that what other faults do does not change it.
bool FaultScript::Pending::is_due(Instant now) {
  if (fault.after_calls > 0) {
    --fault.after_calls;
    return false;
  }
  if (now < Instant(fault.after_time)) return false;
  const double drawn = static_cast<double>(random()) / static_cast<double>(std::mt19937_64::max());
  return drawn <= fault.share;
}

void FaultScript::add(const Fault& fault, std::uint64_t seed) {
  pending_.push_back({fault, std::mt19937_64(seed)});
}

FaultAction FaultScript::next(Instant now, FaultKinds kinds) {
  const FaultAction action = play(now, kinds | set_of({FaultKind::reports}));
  if (action.is(FaultKind::off)) is_off_ = true;
  return is_off_ ? FaultAction(FaultKind::off) : action;
}

DeviceStatus FaultScript::next_start(Instant now) {
  const DeviceStatus status = play(now, set_of({FaultKind::reports, FaultKind::off})).code();
  if (status.ok()) is_off_ = false;
  return status;
}

FaultAction FaultScript::play(Instant now, FaultKinds kinds) {
  FaultAction action;
  for (Pending& pending : pending_) {
    if (!kinds.test(static_cast<std::size_t>(pending.fault.action.kind)) || !pending.is_due(now)) continue;
    if (!action.is(FaultKind::none)) continue;
    action = pending.fault.action;
    if (pending.fault.times != Fault::kForever) --pending.fault.times;
  }
  std::erase_if(pending_, [](const Pending& pending) { return pending.is_spent(); });
  return action;
}

}  // namespace traygauge
