// A button that presses itself, a bounded number of times.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <vector>

#include "drivers/trigger.hpp"
#include "simulator/devices/fault_script.hpp"
#include "simulator/devices/simulated_indicator.hpp"

namespace traygauge {

// The person in front of the station.
struct PersonParams {
  Nanoseconds delay = std::chrono::seconds(1);      // from the lamp's ready to the press
  Nanoseconds patience = std::chrono::seconds(30);  // when nothing happens, or the lamp shows nothing, then
                                                    // the button is tried
  int tries = 20;                                   // in vain, then the person goes away
};

class SimulatedTrigger final : public Trigger {
 public:
  // Pressed at these times, in any order.
  SimulatedTrigger(Clock& clock, std::vector<Instant> presses);
  // Pressed `count` times by a person who looks at the lamp.
  SimulatedTrigger(Clock& clock, const SimulatedIndicator& lamp, std::uint64_t count,
                   const PersonParams& person = {});

  // One more press at a time of its own; only for a schedule.
  void add_press(Instant at);
  // The press that is delivered next after `at` is held for so long; others for no time.
  void hold_press(Instant at, Nanoseconds held) { held_ = {at, held}; }
  // What a person does before pressing, such as putting the next tray there; called for each press that
  // wait_for_press delivers, not for those that a bouncing contact adds.
  void before_press(std::function<void()> action) { before_press_ = std::move(action); }
  // Kinds stuck, late and bounce are asked once a press, off and reports once a start and a wait.
  FaultScript& faults() { return faults_; }

 private:
  // A closing contact on its way to whoever waits.
  struct Edge {
    Instant at;
    Instant seen_at;
    bool is_press;  // else the contact bounced
  };

  DeviceStatus do_start() override { return faults_.next_start(clock_.now()); }
  void do_stop() override {}
  DeviceStatus do_wait_for_press(Nanoseconds timeout, Press& press) override;
  DeviceStatus do_wait_for_release(Nanoseconds timeout) override;
  int do_pending() override;
  void do_discard_pending() override;

  Instant next_press() const;
  void press_at(Instant at);
  bool all_pressed() const { return pressed_ == count_ || tries_ == person_.tries; }

  Clock& clock_;
  std::vector<Instant> schedule_;
  const SimulatedIndicator* lamp_ = nullptr;
  PersonParams person_;
  std::uint64_t count_;
  std::uint64_t pressed_ = 0;
  std::uint64_t sequence_ = 0;
  int tries_ = 0;  // in vain
  Instant last_try_;
  struct Hold {
    Instant after;
    Nanoseconds held{0};
  };
  Hold held_;
  Instant released_at_;     // of the last press delivered
  std::deque<Edge> edges_;  // in the order in which they are seen
  std::function<void()> before_press_;
  FaultScript faults_;
};

}  // namespace traygauge
