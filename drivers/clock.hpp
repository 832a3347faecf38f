// Time as an input: monotonic, of the system or simulated.
#pragma once

#include <chrono>

namespace traygauge {

using Nanoseconds = std::chrono::nanoseconds;
// On Linux this is CLOCK_MONOTONIC, in which the kernel also stamps camera frames and button edges.
using Instant = std::chrono::time_point<std::chrono::steady_clock, Nanoseconds>;

class Clock {
 public:
  Clock() = default;
  Clock(const Clock&) = delete;
  Clock& operator=(const Clock&) = delete;
  virtual ~Clock() = default;

  // Never goes back. Any thread.
  Instant now() const { return do_now(); }
  // Blocks until `instant`; returns at once when it has passed.
  void sleep_until(Instant instant) {
    if (instant > do_now()) do_sleep_until(instant);
  }
  // Blocks for `duration`; returns at once when it is not positive.
  void sleep_for(Nanoseconds duration) { sleep_until(do_now() + duration); }

 private:
  virtual Instant do_now() const = 0;
  virtual void do_sleep_until(Instant instant) = 0;
};

// The system's monotonic clock. Sleeps go on when a signal arrives.
class SystemClock final : public Clock {
 private:
  Instant do_now() const override;
  void do_sleep_until(Instant instant) override;
};

}  // namespace traygauge
