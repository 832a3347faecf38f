// How a call to a device ended: a closed vocabulary, the system's errno kept beside it.
#pragma once

#include <cstdint>

namespace traygauge {

enum class DeviceCode : std::uint8_t {
  ok,
  timed_out,
  ended,
  not_started,
  invalid_argument,
  buffer_too_small,
  out_of_range,
  not_homed,
  busy,
  torn_frame,
  stale_frame,
  unsteady,
  unreadable,
  stalled,
  stuck,
  unsupported,
  no_permission,
  in_use,
  device_gone,
  io_error,
};
inline constexpr int kDeviceCodeCount = static_cast<int>(DeviceCode::io_error) + 1;

// The code as logs and JSON spell it, e.g. "torn_frame".
const char* name(DeviceCode code);

// One sentence: what happened and what to do.
const char* sentence(DeviceCode code);

class [[nodiscard]] DeviceStatus {
 public:
  constexpr DeviceStatus() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): reads as a value
  constexpr DeviceStatus(DeviceCode code, int error_number = 0) : code_(code), error_number_(error_number) {}

  constexpr bool ok() const { return code_ == DeviceCode::ok; }
  constexpr DeviceCode code() const { return code_; }
  // errno of the system call that failed; 0 when none did.
  constexpr int error_number() const { return error_number_; }

 private:
  DeviceCode code_ = DeviceCode::ok;
  int error_number_ = 0;
};

// What an errno of open, ioctl, read or write says of the device.
DeviceStatus status_of_errno(int error_number);

}  // namespace traygauge
