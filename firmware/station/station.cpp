#include "firmware/station/station.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <utility>

#include "firmware/measure/measure_report.hpp"

namespace traygauge {
namespace {

bool shows_wrong_exposure(StatusCode code) {
  return code == StatusCode::frame_too_dark || code == StatusCode::frame_too_bright;
}

bool contradicts_arm(const Measurement& measurement) {
  return measurement.warnings.holds(Warning::arm_angle_disagrees);
}

// Lost steps show in what was seen only: the views are the same, too close, do not fit each other or the
// angle.
bool casts_doubt_on_arm(const Measurement& measurement) {
  return !is_measured(measurement) || contradicts_arm(measurement);
}

// The tray may be moved while its result waits for the hub, but only what the hub has is done.
Signal signal_after(Delivery delivery, Signal signal) {
  if (delivery == Delivery::failed) return Signal::fault;
  return delivery == Delivery::kept && signal == Signal::done ? Signal::busy : signal;
}

}  // namespace

bool spoils_one_scan(DeviceCode code) {
  return code == DeviceCode::torn_frame || code == DeviceCode::unsteady || code == DeviceCode::unreadable;
}

std::vector<std::string> device_names(const StationDevices& devices) {
  std::vector<std::string> names;
  const auto add = [&names](const Device* device) {
    if (device != nullptr) names.emplace_back(device->description());
  };
  for (const Device* const device : std::initializer_list<const Device*>{
           &devices.camera, devices.second_camera, devices.arm, &devices.trigger, &devices.lamp})
    add(device);
  return names;
}

Station::Station(const StationDevices& devices, Measurer& measurer, ResultSink& sink,
                 const std::atomic<bool>& stop, const StationParams& params)
    : devices_(devices), measurer_(measurer), sink_(sink), stop_(stop), params_(params) {
  settled_at_ = devices_.clock.now();  // of cameras that were started before
}

const StationTotals& Station::run(const std::function<void()>& after_step) {
  while (state_ != StationState::finished) {
    step();
    if (after_step) after_step();
  }
  return totals_;
}

StationState Station::step() {
  const StationState before = state_;
  switch (state_) {
    case StationState::starting:
      state_ = start_devices();
      break;
    case StationState::waiting:
      state_ = wait_for_press();
      break;
    case StationState::taking_first_view:
      state_ = take_first_view();
      break;
    case StationState::awaiting_second_view:
      state_ = await_second_view();
      break;
    case StationState::taking_second_view:
      state_ = take_second_view();
      break;
    case StationState::measuring:
      state_ = measure();
      break;
    case StationState::finished:
      break;
  }
  assert(before == StationState::finished || may_follow(before, state_));
  if (state_ == StationState::finished) close_all();
  if (state_ != before) sink_.report_state(name(state_));
  return state_;
}

// The last result stays on the lamp for a while, unless the next press comes first.
StationState Station::wait_for_press() {
  const Instant now = devices_.clock.now();
  sink_.attend();
  if (stop_ || (params_.max_scans > 0 && totals_.scans >= params_.max_scans)) return StationState::finished;
  const bool has_room = sink_.has_room();
  if (now >= result_until_) show(has_room ? Signal::ready : Signal::fault);
  const Nanoseconds wait =
      now < result_until_ ? std::min(result_until_ - now, params_.press_wait) : params_.press_wait;
  Press press;
  const DeviceStatus status = wait_for_press(wait, press);
  const bool is_alive =
      status.ok() || status.code() == DeviceCode::timed_out || status.code() == DeviceCode::ended;
  if (!is_alive) return enter_fault(devices_.trigger, status);
  confirm_recovery();
  if (!status.ok())
    return status.code() == DeviceCode::ended ? StationState::finished : StationState::waiting;
  bool was_held = false;
  const DeviceStatus released = wait_for_release(was_held);
  if (!released.ok()) return enter_fault(devices_.trigger, released);
  if (was_held) return restart_devices();
  return has_room ? begin_scan(press) : refuse_press();
}

StationState Station::begin_scan(const Press& press) {
  ++totals_.scans;
  pressed_at_ = press.at;
  second_means_.clear();
  is_repeated_ = false;
  repeats_last_ = false;
  hint_ = sink_.next_tray();
  return StationState::taking_first_view;
}

// A result that could not be kept is better not measured.
StationState Station::refuse_press() {
  show(Signal::fault);
  result_until_ = devices_.clock.now() + params_.result_shown;
  devices_.trigger.discard_pending();
  return StationState::waiting;
}

// The arm starts to move as soon as the picture is taken, and the measurer works meanwhile.
StationState Station::take_first_view() {
  show(Signal::hold_still);
  if (!take_over_next_view()) {
    const Opening settled = refresh_exposure();
    if (settled.failed != nullptr) return fail_scan(*settled.failed, settled.status);
    const DeviceStatus captured = capture(devices_.camera, first_);
    if (!captured.ok()) return fail_scan(devices_.camera, captured);
    first_means_ = means_[1];
  }
  recognise_tray();
  measurer_.begin_scan(hint_);
  if (devices_.arm != nullptr) {
    const DeviceStatus status = devices_.arm->begin_move_to(params_.second_view_deg);
    if (!status.ok()) return fail_scan(*devices_.arm, status);
  }
  const auto home_deg = devices_.arm != nullptr ? std::optional(0.0) : std::nullopt;
  const Status taken = measurer_.add_view({first_.frame.view, first_.frame.sequence, home_deg});
  return taken.ok() ? StationState::awaiting_second_view : StationState::measuring;
}

// What was known of a tray holds when it is measured again.
void Station::recognise_tray() {
  repeats_last_ = shows_last_tray();
  if (repeats_last_ && hint_ == TrayHint()) hint_ = last_hint_;
}

bool Station::shows_last_tray() const {
  return params_.repeat_within > Nanoseconds::zero() && !last_tray_.empty() &&
         pressed_at_ - last_result_at_ <= params_.repeat_within &&
         first_means_.agrees_with(last_tray_, params_.steadiness);
}

StationState Station::await_second_view() {
  if (devices_.second_camera != nullptr) return StationState::taking_second_view;
  if (devices_.arm == nullptr) return await_second_press();
  const DeviceStatus status = devices_.arm->wait_until_still(params_.arm_timeout);
  return status.ok() ? StationState::taking_second_view : fail_scan(*devices_.arm, status);
}

StationState Station::take_second_view() {
  show(Signal::hold_still);
  std::optional<double> angle_deg;
  if (devices_.arm != nullptr) {
    const DeviceStatus status = devices_.arm->read_position(angle_deg.emplace());
    if (!status.ok()) return fail_scan(*devices_.arm, status);
    *angle_deg *= params_.seen_per_commanded;
  }
  const DeviceStatus status = capture(second_camera(), second_);
  if (!status.ok()) return fail_scan(second_camera(), status);
  second_means_ = means_[1];
  // What goes wrong in the measurement, measure() says too.
  static_cast<void>(measurer_.add_view(
      {second_.frame.view, second_.frame.sequence, angle_deg, devices_.second_camera != nullptr}));
  return StationState::measuring;
}

// The arm goes home while the volumes are computed. Where it stood elsewhere than it said, the scan is taken
// again, once.
StationState Station::measure() {
  show(Signal::busy);
  const DeviceStatus returning = begin_return();
  const Measurement& measurement = await_measurement();
  exposure_is_doubtful_ = shows_wrong_exposure(measurement.status.code());
  const bool stood_elsewhere =
      devices_.arm != nullptr && is_measured(measurement) && contradicts_arm(measurement);
  if (stood_elsewhere && !is_repeated_ && !next_press_) return repeat_scan(returning);
  const bool measured = is_measured(measurement) && !stood_elsewhere;
  ScanResult result;
  result.outcome = measured ? ScanOutcome::measured : ScanOutcome::not_measurable;
  result.measurement = &measurement;
  result.picture = first_.frame.view;
  result.lens_spot = measurer_.lens_spot();
  if (stood_elsewhere) {
    result.outcome = ScanOutcome::device_failed;
    result.measurement = nullptr;
    result.failure = {devices_.arm->description(), DeviceCode::stalled,
                      is_repeated_ ? "twice the pictures show another angle than the arm's"
                                   : "the pictures show another angle than the arm's"};
  }
  end_scan(result, measured ? Signal::done : Signal::try_again, StationState::waiting);
  const StationState next = returning.ok()
                                ? finish_return(StationState::waiting, casts_doubt_on_arm(measurement))
                                : enter_fault(*devices_.arm, returning);
  if (next == StationState::waiting) return begin_next_scan();
  next_press_.reset();
  return next;
}

StationState Station::repeat_scan(DeviceStatus returning) {
  is_repeated_ = true;
  if (returning.ok()) returning = devices_.arm->wait_until_still(params_.arm_timeout);
  if (returning.ok()) returning = devices_.arm->home(params_.arm_timeout);
  return returning.ok() ? StationState::taking_first_view : fail_scan(*devices_.arm, returning);
}

// A press soon after the last one is the same one, bouncing: timed_out.
DeviceStatus Station::wait_for_press(Nanoseconds timeout, Press& press) {
  const DeviceStatus status = devices_.trigger.wait_for_press(timeout, press);
  if (!status.ok()) return status;
  const bool bounces = last_edge_at_ && press.at - *last_edge_at_ < params_.bounce_time;
  last_edge_at_ = press.at;
  return bounces ? DeviceCode::timed_out : DeviceCode::ok;
}

// Where long presses mean nothing, a press does not wait for its end.
DeviceStatus Station::wait_for_release(bool& was_held) {
  was_held = false;
  if (params_.long_press <= Nanoseconds::zero()) return DeviceCode::ok;
  const DeviceStatus status = devices_.trigger.wait_for_release(params_.long_press);
  was_held = status.code() == DeviceCode::timed_out;
  return was_held ? DeviceCode::ok : status;
}

// NOLINTNEXTLINE(readability-make-member-function-const): the station's arm moves
DeviceStatus Station::begin_return() {
  if (devices_.arm == nullptr) return DeviceCode::ok;
  const DeviceStatus still = devices_.arm->wait_until_still(params_.arm_timeout);
  return still.ok() ? devices_.arm->begin_move_to(0.0) : still;
}

// An arm that may stand elsewhere than it says finds its switch again.
StationState Station::finish_return(StationState next, bool arm_is_doubtful) {
  if (devices_.arm == nullptr) return next;
  DeviceStatus status = devices_.arm->wait_until_still(params_.arm_timeout);
  if (status.ok() && arm_is_doubtful) status = devices_.arm->home(params_.arm_timeout);
  return status.ok() ? next : enter_fault(*devices_.arm, status);
}

// Delivers what became of the press, then shows it. Presses during the scan count as impatience.
StationState Station::end_scan(ScanResult result, Signal signal, StationState next) {
  result.scan = totals_.scans;
  result.tray = hint_.tray.empty() ? measurer_.tray_name() : hint_.tray;
  result.duration = devices_.clock.now() - pressed_at_;
  result.repeats_last = repeats_last_;
  const Delivery delivery = sink_.deliver(result);
  if (delivery == Delivery::failed) ++totals_.undelivered;
  if (delivery != Delivery::failed && result.outcome == ScanOutcome::measured) ++totals_.measured;
  if (delivery == Delivery::kept) ++totals_.kept;
  show(signal_after(delivery, signal));
  last_result_at_ = devices_.clock.now();
  last_tray_ = result.measurement != nullptr ? first_means_ : BlockMeans();
  last_hint_ = hint_;
  result_until_ = last_result_at_ + params_.result_shown;
  devices_.trigger.discard_pending();
  return next;
}

// The result says what failed, so that the fault itself is not told a second time.
StationState Station::fail_scan(Device& device, DeviceStatus status) {
  ScanResult result;
  result.outcome = ScanOutcome::device_failed;
  result.failure = {device.description(), status, device.detail()};
  if (!spoils_one_scan(status.code())) {
    // A camera that hangs usually works once it is opened again: no case for somebody to come.
    const bool may_try_again = status.code() == DeviceCode::stale_frame;
    remember_failure(device, status);
    return end_scan(result, may_try_again ? Signal::try_again : Signal::fault, StationState::starting);
  }
  end_scan(result, Signal::try_again, StationState::waiting);
  const DeviceStatus returning = begin_return();
  return returning.ok() ? finish_return(StationState::waiting, false) : enter_fault(*devices_.arm, returning);
}

}  // namespace traygauge
