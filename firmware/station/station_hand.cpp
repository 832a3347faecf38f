// The second view without an arm: the lamp guides the hand that moves the camera or the tray.
#include <algorithm>
#include <optional>
#include <utility>

#include "firmware/station/station.hpp"

namespace traygauge {
namespace {

Signal signal_for(std::optional<double> turned_deg, const HandGuideParams& params) {
  if (!turned_deg || *turned_deg < params.enough_from_deg) return Signal::move_on;
  return *turned_deg <= params.enough_to_deg ? Signal::far_enough : Signal::too_far;
}

}  // namespace

StationState Station::await_second_press() {
  const bool guides = measurer_.can_guide();
  if (!guides) show(Signal::ready);
  devices_.trigger.discard_pending();
  means_[0].clear();
  guidance_ = Signal::move_on;
  const Instant deadline = devices_.clock.now() + params_.second_press_timeout;
  while (!stop_ && devices_.clock.now() < deadline) {
    if (guides) {
      if (const DeviceStatus status = guide_hand(); !status.ok()) return fail_scan(devices_.camera, status);
    }
    Press press;
    const Nanoseconds wait =
        std::min(deadline - devices_.clock.now(), guides ? params_.guide.interval : params_.press_wait);
    DeviceStatus status = wait_for_press(std::max(wait, Nanoseconds(1)), press);
    bool was_held = false;
    if (status.ok()) {
      status = wait_for_release(was_held);
      if (status.ok()) return was_held ? cancel_scan(true) : StationState::taking_second_view;
    }
    if (status.code() == DeviceCode::ended) break;
    if (status.code() != DeviceCode::timed_out) return fail_scan(devices_.trigger, status);
  }
  return cancel_scan(false);
}

// Looks where the camera is, and lets the lamp say where to. A picture that shows the same as the last one
// says the same. Damaged ones are left out.
DeviceStatus Station::guide_hand() {
  const DeviceStatus status = devices_.camera.capture(second_.pixels, params_.capture_timeout, second_.frame);
  if (!status.ok())
    return spoils_one_scan(status.code()) || status.code() == DeviceCode::stale_frame ? DeviceCode::ok
                                                                                      : status;
  auto& [last, current] = means_;
  current.compute(second_.frame.view);
  if (!current.agrees_with(last, params_.steadiness)) {
    std::swap(last, current);
    guidance_ = signal_for(measurer_.turned_deg(second_.frame.view), params_.guide);
  }
  show(guidance_);
  return DeviceCode::ok;
}

StationState Station::cancel_scan(bool was_held) {
  ScanResult result;
  result.outcome = ScanOutcome::cancelled;
  result.was_held = was_held;
  return end_scan(result, was_held ? Signal::ready : Signal::try_again, StationState::waiting);
}

}  // namespace traygauge
