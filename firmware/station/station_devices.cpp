// How the station opens its devices and takes pictures, and how it goes on when a device fails.
#include <algorithm>
#include <utility>

#include "firmware/station/station.hpp"

namespace traygauge {

StationState Station::start_devices() {
  if (stop_) return StationState::finished;
  devices_.clock.sleep_for(retry_after_);
  const Opening opening = open_all();
  if (opening.failed != nullptr) return enter_fault(*opening.failed, opening.status);
  devices_.trigger.discard_pending();
  return StationState::waiting;
}

// What somebody who holds the button expects of it: that everything begins anew. The button's own line is
// left alone: while it is pressed it could not be opened.
StationState Station::restart_devices() {
  sink_.report_restart();
  show(Signal::busy);
  close_views();
  return StationState::starting;
}

Station::Opening Station::open_all() {
  if (const DeviceStatus status = devices_.trigger.start(); !status.ok()) return {&devices_.trigger, status};
  if (const DeviceStatus status = open_camera(devices_.camera); !status.ok())
    return {&devices_.camera, status};
  if (devices_.second_camera != nullptr) {
    const DeviceStatus status = open_camera(*devices_.second_camera);
    if (!status.ok()) return {devices_.second_camera, status};
  }
  if (devices_.arm == nullptr) return {};
  DeviceStatus status = devices_.arm->start();
  if (status.ok() && !devices_.arm->is_homed()) status = devices_.arm->home(params_.arm_timeout);
  if (status.ok()) status = devices_.arm->move_to(0.0, params_.arm_timeout);
  return status.ok() ? Opening{} : Opening{devices_.arm, status};
}

// For both views of a scan at once, since they have to be alike.
Station::Opening Station::refresh_exposure() {
  const Instant now = devices_.clock.now();
  if (!exposure_is_doubtful_ && now - settled_at_ < params_.exposure_good_for) return {};
  for (Camera* const camera : {&devices_.camera, devices_.second_camera}) {
    if (camera == nullptr) continue;
    if (const DeviceStatus status = camera->settle_again(); !status.ok()) return {camera, status};
  }
  settled_at_ = devices_.clock.now();
  exposure_is_doubtful_ = false;
  return {};
}

DeviceStatus Station::open_camera(Camera& camera) {
  if (!camera.is_started()) settled_at_ = devices_.clock.now();
  const DeviceStatus status = camera.start();
  if (!status.ok()) return status;
  const CameraFormat format = camera.format();
  const std::size_t frame_bytes = format.frame_bytes();
  View& view = &camera == &devices_.camera ? first_ : second_;
  if (view.pixels.size() != frame_bytes) view.pixels.resize(frame_bytes);
  if (devices_.second_camera == nullptr && second_.pixels.size() != frame_bytes)
    second_.pixels.resize(frame_bytes);
  if (params_.takes_next_tray_early && &camera == &devices_.camera) next_.pixels.resize(frame_bytes);
  for (BlockMeans& means : means_) means.reserve(format.width, format.height);
  return status;
}

// A picture that the one before it confirms: damage that the camera does not notice, such as rows of an older
// picture, can otherwise pass for food.
DeviceStatus Station::capture(Camera& camera, View& view) {
  const Instant not_before = devices_.clock.now();
  DeviceStatus failure = DeviceCode::unsteady;
  auto& [last, current] = means_;
  current.clear();
  for (int attempt = 0; attempt < params_.capture_attempts; ++attempt) {
    const DeviceStatus status = capture_once(camera, view, not_before);
    if (status.code() == DeviceCode::device_gone) return status;
    if (!status.ok()) {
      failure = status;
      continue;
    }
    std::swap(last, current);
    current.compute(view.frame.view);
    if (current.agrees_with(last, params_.steadiness)) return DeviceCode::ok;
    if (!last.empty()) failure = DeviceCode::unsteady;
  }
  return failure;
}

// Exposed after `not_before`, so that nothing moved in it.
DeviceStatus Station::capture_once(Camera& camera, View& view, Instant not_before) const {
  const DeviceStatus status = camera.capture(view.pixels, params_.capture_timeout, view.frame);
  const bool is_old = status.ok() && view.frame.exposed_at < not_before;
  return is_old ? DeviceStatus(DeviceCode::stale_frame) : status;
}

// Told when it is new; the same failure again only makes the next try later.
StationState Station::enter_fault(Device& device, DeviceStatus status) {
  const bool is_known = &device == failed_device_ && status.code() == failed_code_;
  const Nanoseconds last_wait = retry_after_;
  if (!is_known) sink_.report_fault({device.description(), status, device.detail()});
  remember_failure(device, status);
  if (is_known) retry_after_ = std::clamp(2 * last_wait, params_.first_retry, params_.last_retry);
  show(Signal::fault);
  totals_.gave_up = params_.max_retries > 0 && ++retries_ > params_.max_retries;
  return totals_.gave_up ? StationState::finished : StationState::starting;
}

void Station::remember_failure(Device& device, DeviceStatus status) {
  failed_device_ = &device;
  failed_code_ = status.code();
  retry_after_ = params_.first_retry;
  close(device);
}

void Station::confirm_recovery() {
  if (failed_device_ != nullptr) sink_.report_recovery("all devices");
  failed_device_ = nullptr;
  retry_after_ = Nanoseconds::zero();
  retries_ = 0;
}

void Station::close(const Device& device) {
  if (&device == &devices_.camera) devices_.camera.stop();
  if (&device == devices_.second_camera) devices_.second_camera->stop();
  if (&device == &devices_.trigger) devices_.trigger.stop();
  if (&device == devices_.arm) devices_.arm->stop();
}

void Station::close_all() {
  close_views();
  devices_.trigger.stop();
  devices_.lamp.stop();
}

void Station::close_views() {
  devices_.camera.stop();
  second_camera().stop();
  if (devices_.arm != nullptr) devices_.arm->stop();
}

// A dead lamp does not stop the scans; it is told once, and opened again for the next signal.
void Station::show(Signal signal) {
  if (lamp_failed_) devices_.lamp.stop();
  DeviceStatus status = devices_.lamp.start();
  if (status.ok()) status = devices_.lamp.show(signal);
  if (!status.ok() && !lamp_failed_) {
    sink_.report_fault({devices_.lamp.description(), status, devices_.lamp.detail()});
  }
  if (status.ok() && lamp_failed_) sink_.report_recovery(devices_.lamp.description());
  lamp_failed_ = !status.ok();
}

}  // namespace traygauge
