// A button that presses itself, a bounded number of times.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "drivers/trigger.hpp"
#include "simulator/devices/fault_script.hpp"
#include "simulator/devices/simulated_indicator.hpp"

namespace traygauge {

class SimulatedTrigger final : public Trigger {
 public:
  // Pressed at these times, in any order.
  SimulatedTrigger(Clock& clock, std::vector<Instant> presses);
  // Pressed `count` times, each `delay` after the lamp says ready.
  SimulatedTrigger(Clock& clock, const SimulatedIndicator& lamp, std::uint64_t count, Nanoseconds delay);

  // One more press at a time of its own; only for a schedule.
  void add_press(Instant at);
  // What a person does before pressing, such as putting the next tray there; called for each press that
  // wait_for_press delivers.
  void before_press(std::function<void()> action) { before_press_ = std::move(action); }
  // Asked once a start and a wait.
  FaultScript& faults() { return faults_; }

 private:
  DeviceStatus do_start() override { return faults_.next(); }
  void do_stop() override {}
  DeviceStatus do_wait_for_press(Nanoseconds timeout, Press& press) override;
  int do_pending() const override;
  void do_discard_pending() override;

  bool next_press(Instant& at) const;  // false while the lamp is not ready
  bool all_pressed() const { return pressed_ == count_; }

  Clock& clock_;
  std::vector<Instant> schedule_;
  const SimulatedIndicator* lamp_ = nullptr;
  Nanoseconds delay_{0};
  std::uint64_t count_;
  std::uint64_t pressed_ = 0;
  std::function<void()> before_press_;
  FaultScript faults_;
};

}  // namespace traygauge
