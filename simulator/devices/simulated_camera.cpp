#include "simulator/devices/simulated_camera.hpp"

#include <algorithm>
#include <cmath>

#include "simulator/devices/frame_faults.hpp"

namespace traygauge {

SimulatedCamera::SimulatedCamera(Clock& clock, TrayPlayer& player, const SimulatedArm* arm,
                                 const SimulatedCameraParams& params)
    : Camera("simulated camera"), clock_(clock), player_(player), arm_(arm), params_(params) {}

DeviceStatus SimulatedCamera::do_capture(std::span<std::uint8_t> buffer, Nanoseconds timeout,
                                         CapturedFrame& frame) {
  using enum FaultKind;
  const FaultAction fault =
      faults_.next(clock_.now(), set_of({off, stuck, stale, late, garbage, torn, mixed, wrong_size}));
  const DeviceCode code = fault.code();
  if (fault.is(off)) return code;
  // Frame n is exposed at n intervals since time began.
  const auto frames_so_far = clock_.now().time_since_epoch() / params_.frame_interval;
  const Instant exposed_at(params_.frame_interval * (frames_so_far + 1));
  const Instant delivered_at = exposed_at + params_.transfer_time + fault.delay();
  if (code == DeviceCode::timed_out || delivered_at - clock_.now() > timeout) {
    clock_.sleep_for(timeout);
    return DeviceCode::timed_out;
  }
  clock_.sleep_until(exposed_at);
  PlayedFrame seen = look();
  clock_.sleep_until(delivered_at);
  if (!player_.has_tray()) {
    set_detail(player_.problem());
    return DeviceCode::unreadable;
  }
  const bool repeats = code == DeviceCode::stale_frame && last_sequence_ > 0;
  if (code == DeviceCode::torn_frame) {
    const FrameView whole = pixels_of(seen.view);
    copy_part(whole, whole.width, whole.height / 2, buffer);
  }
  if (code != DeviceCode::ok && !repeats) return code;

  seen.sequence = repeats ? last_sequence_ : static_cast<std::uint64_t>(frames_so_far + 1);
  frame.view = deliver(fault, seen, buffer);
  frame.exposed_at = exposed_at;
  frame.delivered_at = delivered_at;
  frame.sequence = seen.sequence;
  last_sequence_ = frame.sequence;
  return DeviceCode::ok;
}

PlayedFrame SimulatedCamera::look() const {
  if (arm_ == nullptr) return {.view = player_.view_seen_by_hand()};
  const double position_deg = arm_->true_position_deg();
  const int view = player_.view_seen_at(position_deg, arm_->aimed_deg());
  const double recorded_deg = view == 0 ? 0.0 : player_.second_view_angle_deg().value_or(position_deg);
  return {.view = view, .off_deg = recorded_deg - position_deg};
}

FrameView SimulatedCamera::deliver(const FaultAction& fault, const PlayedFrame& seen,
                                   std::span<std::uint8_t> buffer) {
  const FrameView whole = pixels_of(seen.view);
  if (fault.is(FaultKind::stuck) && !last_view_.empty()) {
    player_.note_repeated(seen);
    return copy_frame(last_view_, buffer);
  }
  player_.note_played(seen);
  const FrameView delivered = spoil(fault, whole, seen.sequence, buffer);
  if (!faults_.empty()) remember(whole);
  return delivered;
}

FrameView SimulatedCamera::spoil(const FaultAction& fault, const FrameView& whole, std::uint64_t sequence,
                                 std::span<std::uint8_t> buffer) const {
  const bool has_other = last_view_.width == whole.width && last_view_.height == whole.height;
  if (fault.is(FaultKind::garbage)) return fill_with_noise(whole, sequence, buffer);
  if (fault.is(FaultKind::mixed) && has_other) return mix_frames(whole, last_view_, fault.amount, buffer);
  if (!fault.is(FaultKind::wrong_size)) return copy_frame(whole, buffer);
  const auto part = [&fault](int side) {
    return std::max(1, static_cast<int>(std::lround(fault.amount * side)));
  };
  return copy_part(whole, part(whole.width), part(whole.height), buffer);
}

void SimulatedCamera::remember(const FrameView& view) {
  last_pixels_.resize(static_cast<std::size_t>(view.stride_bytes * view.height));
  last_view_ = copy_frame(view, last_pixels_);
}

}  // namespace traygauge
