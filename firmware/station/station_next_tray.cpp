// What the station does with a press while it measures: a person in a queue has put the next tray there.
#include <utility>

#include "firmware/station/station.hpp"

namespace traygauge {

const Measurement& Station::await_measurement() {
  measurer_.begin_measuring();
  while (true) {
    const Measurement* const measurement = measurer_.await_measurement(params_.next_tray_wait);
    if (measurement != nullptr) return *measurement;
    if (params_.takes_next_tray_early && !next_press_) look_for_next_tray();
  }
}

// A button that fails is told later, by the state that waits for it. An arm is still on its way home: with
// one the picture is taken later, too.
void Station::look_for_next_tray() {
  const bool is_last = params_.max_scans > 0 && totals_.scans >= params_.max_scans;
  if (stop_ || is_last || devices_.trigger.pending() == 0 || !sink_.has_room()) return;
  Press press;
  if (!wait_for_press(Nanoseconds(1), press).ok()) return;
  bool was_held = false;
  if (!wait_for_release(was_held).ok() || was_held) return;
  next_press_ = press;
  is_next_taken_ = false;
  if (devices_.arm == nullptr) take_next_view();
}

// Somebody who grew impatient pressed for the same tray: that starts nothing. A picture that fails is taken,
// and told, once the scan begins.
void Station::take_next_view() {
  show(Signal::hold_still);
  const DeviceStatus status = capture(devices_.camera, next_);
  show(Signal::busy);
  if (!status.ok()) return;
  next_means_ = means_[1];
  const bool is_same_tray = next_means_.agrees_with(first_means_, params_.steadiness) ||
                            next_means_.agrees_with(second_means_, params_.steadiness);
  if (is_same_tray) next_press_.reset();
  is_next_taken_ = !is_same_tray;
}

// Both views of a scan need one exposure: where the last pictures were too dark or too bright, the first is
// taken again with a new one.
StationState Station::begin_next_scan() {
  if (next_press_ && !is_next_taken_) take_next_view();
  if (stop_ || exposure_is_doubtful_) is_next_taken_ = false;
  if (stop_) next_press_.reset();
  return next_press_ ? begin_scan(*std::exchange(next_press_, std::nullopt)) : StationState::waiting;
}

bool Station::take_over_next_view() {
  if (!is_next_taken_) return false;
  std::swap(first_, next_);
  std::swap(first_means_, next_means_);
  is_next_taken_ = false;
  return true;
}

}  // namespace traygauge
