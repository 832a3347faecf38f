// Time that moves only when somebody sleeps or says so: hours pass in a moment, the same way every time.
#pragma once

#include <atomic>

#include "drivers/clock.hpp"

namespace traygauge {

// Starts at 0. Whoever sleeps moves the time for everybody, at once.
class SimulatedClock final : public Clock {
 public:
  // Nothing happens when `duration` is not positive.
  void advance(Nanoseconds duration) { sleep_for(duration); }

 private:
  Instant do_now() const override { return Instant(Nanoseconds(now_ns_.load())); }
  void do_sleep_until(Instant instant) override {
    const auto target_ns = instant.time_since_epoch().count();
    auto seen_ns = now_ns_.load();
    while (seen_ns < target_ns && !now_ns_.compare_exchange_weak(seen_ns, target_ns)) {
    }
  }

  std::atomic<Nanoseconds::rep> now_ns_{0};
};

}  // namespace traygauge
