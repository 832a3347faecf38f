#include "simulator/devices/simulated_camera.hpp"

#include <cstring>

namespace traygauge {
namespace {

// The first rows of `source` as a picture of their own in `buffer`.
FrameView copy_rows(const FrameView& source, int rows, std::span<std::uint8_t> buffer) {
  const std::ptrdiff_t row_bytes = std::ptrdiff_t{source.width} * bytes_per_pixel(source.format);
  for (int y = 0; y < rows; ++y) {
    std::memcpy(buffer.data() + y * row_bytes, source.data + y * source.stride_bytes,
                static_cast<std::size_t>(row_bytes));
  }
  return {buffer.data(), source.width, rows, row_bytes, source.format};
}

}  // namespace

SimulatedCamera::SimulatedCamera(Clock& clock, TrayPlayer& player, const SimulatedArm* arm,
                                 const SimulatedCameraParams& params)
    : Camera("simulated camera"), clock_(clock), player_(player), arm_(arm), params_(params) {}

DeviceStatus SimulatedCamera::do_start() {
  return faults_.next();
}

DeviceStatus SimulatedCamera::do_capture(std::span<std::uint8_t> buffer, Nanoseconds timeout,
                                         CapturedFrame& frame) {
  // Frame n is exposed at n intervals since time began.
  const auto frames_so_far = clock_.now().time_since_epoch() / params_.frame_interval;
  const Instant exposed_at(params_.frame_interval * (frames_so_far + 1));
  const Instant delivered_at = exposed_at + params_.transfer_time;
  const DeviceStatus fault = faults_.next();
  if (fault.code() == DeviceCode::timed_out || delivered_at - clock_.now() > timeout) {
    clock_.sleep_for(timeout);
    return DeviceCode::timed_out;
  }
  clock_.sleep_until(exposed_at);
  const int seen =
      arm_ != nullptr ? player_.view_seen_at(arm_->true_position_deg()) : player_.view_seen_by_hand();
  clock_.sleep_until(delivered_at);
  if (!player_.has_tray()) {
    set_detail(player_.problem());
    return DeviceCode::unreadable;
  }
  const FrameView& source = player_.captures().pair()[static_cast<std::size_t>(seen)].frame;
  if (fault.code() == DeviceCode::torn_frame) copy_rows(source, source.height / 2, buffer);
  const bool repeats = fault.code() == DeviceCode::stale_frame && last_sequence_ > 0;
  if (!fault.ok() && !repeats) return fault;

  frame.view = copy_rows(source, source.height, buffer);
  frame.exposed_at = exposed_at;
  frame.delivered_at = delivered_at;
  frame.sequence = repeats ? last_sequence_ : static_cast<std::uint64_t>(frames_so_far + 1);
  last_sequence_ = frame.sequence;
  player_.note_played(frame.sequence, seen);
  return DeviceCode::ok;
}

}  // namespace traygauge
