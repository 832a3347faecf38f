// Time that moves only when somebody sleeps or says so: hours pass in a moment, the same way every time.
#pragma once

#include <atomic>
#include <mutex>

#include "drivers/clock.hpp"
#include "simulator/devices/fault_script.hpp"

namespace traygauge {

// Starts at 0. Whoever sleeps moves the time for everybody, at once. Time never goes back: what can go wrong
// with a monotonic clock is that a sleeper wakes up too late, because the processor was busy or suspended.
class SimulatedClock final : public Clock {
 public:
  // From now on whoever sleeps really does, for as long as the time moves: for people who watch.
  void run_in_real_time() { is_real_ = true; }
  // Nothing happens when `duration` is not positive.
  void advance(Nanoseconds duration) { move_to(do_now() + duration); }
  // Asked once a sleep that lasts. Not to be changed while another thread sleeps.
  FaultScript& faults() { return faults_; }

 private:
  Instant do_now() const override { return Instant(Nanoseconds(now_ns_.load())); }
  void do_sleep_until(Instant instant) override;
  void move_to(Instant instant);

  std::atomic<Nanoseconds::rep> now_ns_{0};
  std::atomic<bool> is_real_{false};
  std::mutex faults_mutex_;
  FaultScript faults_;
};

}  // namespace traygauge
