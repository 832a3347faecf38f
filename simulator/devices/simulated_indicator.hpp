// A lamp that remembers what it showed.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "drivers/clock.hpp"
#include "drivers/indicator.hpp"
#include "simulator/devices/fault_script.hpp"

namespace traygauge {

struct ShownSignal {
  Signal signal = Signal::off;
  Instant since;

  friend bool operator==(const ShownSignal&, const ShownSignal&) = default;
};

class SimulatedIndicator final : public Indicator {
 public:
  explicit SimulatedIndicator(const Clock& clock) : Indicator("simulated lamp"), clock_(clock) {}

  // Everything that was shown, in order.
  const std::vector<ShownSignal>& history() const { return history_; }
  // What a person sees now, whatever the station believes; dark while it is off.
  ShownSignal seen() const { return faults_.is_off() || history_.empty() ? ShownSignal{} : history_.back(); }
  // Who looks at the lamp; called for each signal that lights up.
  void on_signal(std::function<void(Signal)> action) { on_signal_ = std::move(action); }
  // Asked once a start and a show.
  FaultScript& faults() { return faults_; }

 private:
  DeviceStatus do_start() override { return faults_.next_start(clock_.now()); }
  void do_stop() override {}
  DeviceStatus do_show(Signal signal) override {
    const FaultAction fault = faults_.next(clock_.now(), set_of({FaultKind::off, FaultKind::stuck}));
    if (!fault.is(FaultKind::none)) return fault.code();
    history_.push_back({signal, clock_.now()});
    if (on_signal_) on_signal_(signal);
    return DeviceCode::ok;
  }

  const Clock& clock_;
  FaultScript faults_;
  std::vector<ShownSignal> history_;
  std::function<void(Signal)> on_signal_;
};

}  // namespace traygauge
