#include "drivers/camera.hpp"

#include <functional>

namespace traygauge {
namespace {

bool lies_within(const FrameView& view, std::span<const std::uint8_t> buffer) {
  if (view.empty()) return false;
  const std::ptrdiff_t row_bytes = std::ptrdiff_t{view.width} * bytes_per_pixel(view.format);
  if (view.stride_bytes < row_bytes) return false;
  const std::less<> before;  // also orders pointers into different objects
  const std::uint8_t* const end = buffer.data() + buffer.size();
  if (before(view.data, buffer.data()) || !before(view.data, end)) return false;
  return (view.height - 1) * view.stride_bytes + row_bytes <= end - view.data;
}

}  // namespace

DeviceStatus Camera::start() {
  if (started_) return DeviceCode::ok;
  const DeviceStatus status = do_start();
  started_ = status.ok();
  last_sequence_.reset();
  return status;
}

void Camera::stop() {
  if (started_) do_stop();
  started_ = false;
}

DeviceStatus Camera::capture(std::span<std::uint8_t> buffer, Nanoseconds timeout, CapturedFrame& frame) {
  frame = {};
  set_detail({});
  if (!started_) return DeviceCode::not_started;
  if (timeout <= Nanoseconds::zero()) return DeviceCode::invalid_argument;
  const std::size_t frame_bytes = do_format().frame_bytes();
  if (buffer.size() < frame_bytes) return DeviceCode::buffer_too_small;
  const auto own = buffer.first(frame_bytes);

  CapturedFrame captured;
  const DeviceStatus status = do_capture(own, timeout, captured);
  if (!status.ok()) return status;
  if (!lies_within(captured.view, own)) return DeviceCode::torn_frame;
  if (last_sequence_ && captured.sequence <= *last_sequence_) return DeviceCode::stale_frame;
  last_sequence_ = captured.sequence;
  frame = captured;
  return DeviceCode::ok;
}

DeviceStatus Camera::settle_again() {
  set_detail({});
  return started_ ? do_settle_again() : DeviceCode::not_started;
}

}  // namespace traygauge
