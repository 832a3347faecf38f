#include "simulator/devices/simulated_clock.hpp"

#include <thread>

namespace traygauge {

void SimulatedClock::do_sleep_until(Instant instant) {
  const Instant now = do_now();
  FaultAction fault;
  {
    const std::lock_guard lock(faults_mutex_);
    fault = faults_.next(now, set_of({FaultKind::late, FaultKind::slow}));
  }
  const double slowness = fault.is(FaultKind::slow) ? fault.amount : 1.0;
  const auto lasts = std::chrono::round<Nanoseconds>(std::chrono::duration<double, std::nano>(
      static_cast<double>((instant - now).count()) * (slowness - 1.0)));
  move_to(instant + lasts + fault.delay());
}

void SimulatedClock::move_to(Instant instant) {
  const auto target_ns = instant.time_since_epoch().count();
  auto seen_ns = now_ns_.load();
  if (is_real_ && seen_ns < target_ns) std::this_thread::sleep_for(Nanoseconds(target_ns - seen_ns));
  while (seen_ns < target_ns && !now_ns_.compare_exchange_weak(seen_ns, target_ns)) {
  }
}

}  // namespace traygauge
