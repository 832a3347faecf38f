// A button on a GPIO line.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>

#include "drivers/gpio/gpio_line.hpp"
#include "drivers/trigger.hpp"

namespace traygauge {

struct GpioTriggerParams {
  GpioLineParams line{"TRIGGER", true, GpioBias::pull_up};  // a contact to ground
  // Contacts bounce for 1 to 10 ms, worn ones longer; nobody presses again within so little time.
  Nanoseconds debounce = std::chrono::milliseconds(30);
  // What motors and lamps couple into a long wire closes a contact for microseconds; a finger for 50 ms and
  // more.
  Nanoseconds least_closed = std::chrono::milliseconds(5);
  Nanoseconds stuck_after = std::chrono::seconds(20);  // pressed for so long: something lies on it
};

// A press counts at its first edge, by the kernel's time, when the contact was open for `debounce` before and
// then is closed for `least_closed` at a stretch.
// What bounces afterwards, at the release too, is none. It is released when the contact was open for
// `debounce`. While the button stays pressed beyond `stuck_after`, waiting ends with `stuck`, as does
// start().
class GpioTrigger final : public Trigger {
 public:
  // `clock` is the one that stamps edges: SystemClock. It outlives the trigger.
  GpioTrigger(std::unique_ptr<GpioLine> line, Clock& clock, const GpioTriggerParams& params);
  ~GpioTrigger() override { stop(); }

 private:
  DeviceStatus do_start() override;
  void do_stop() override { line_->close(); }
  DeviceStatus do_wait_for_press(Nanoseconds timeout, Press& press) override;
  DeviceStatus do_wait_for_release(Nanoseconds timeout) override;
  int do_pending() override;
  void do_discard_pending() override;

  void take(const GpioEdge& edge);
  // The contact has stayed as it is until `now`.
  void confirm_press(Instant now);
  Nanoseconds until_confirmed() const;
  DeviceStatus take_waiting_edges();
  bool is_stuck() const;

  std::unique_ptr<GpioLine> line_;
  Clock& clock_;
  GpioTriggerParams params_;
  std::deque<Instant> presses_;
  std::uint64_t sequence_ = 0;
  bool is_active_ = false;  // after the last edge
  Instant last_edge_at_;
  std::optional<Instant> begun_at_;       // a press that was not closed long enough yet
  std::optional<Instant> differs_since_;  // the line from is_active_
};

}  // namespace traygauge
