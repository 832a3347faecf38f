// What can go wrong with the simulated devices.
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>

#include "drivers/clock.hpp"
#include "drivers/device_status.hpp"

namespace traygauge {

enum class SimulatedDevice : std::uint8_t { camera, button, arm, lamp, clock };
inline constexpr std::size_t kSimulatedDeviceCount = static_cast<std::size_t>(SimulatedDevice::clock) + 1;
const char* name(SimulatedDevice device);

enum class FaultKind : std::uint8_t {
  none,
  reports,       // the call ends with a given status
  off,           // gone until it is started again
  stuck,         // camera: the last picture again, as a new one; button: no press gets through; arm: does not
                 // move and says it did; lamp: goes on showing what it showed
  stale,         // the last picture again, under its old number
  late,          // by so many ms: a picture, a press, the end of a sleep
  garbage,       // noise, delivered as a picture
  torn,          // half of a picture, reported as such
  mixed,         // the last rows, or with a negative share the first, are the last picture's; delivered as a
                 // picture
  wrong_size,    // the upper left part of the picture, delivered as a picture
  bounce,        // a press closes the contact so many times within some ms
  wrong_angle,   // a move ends so many degrees from where the arm says it stands
  stall,         // a move stops half way
  silent_stall,  // a move stops half way, and the arm says it has arrived
  slow,          // so many times slower
};
inline constexpr std::size_t kFaultKindCount = static_cast<std::size_t>(FaultKind::slow) + 1;
const char* name(FaultKind kind);

using FaultKinds = std::bitset<kFaultKindCount>;
FaultKinds set_of(std::initializer_list<FaultKind> kinds);

// The number that says how much, where a kind has one.
struct FaultAmount {
  const char* key = nullptr;  // as scripts spell it, with its unit
  double min = 0.0;
  double max = 0.0;
};
// Null: this kind has none.
const FaultAmount* amount_of(FaultKind kind);
// The kinds that a script may name for this device.
std::span<const FaultKind> kinds_of(SimulatedDevice device);

// What spoils one call.
struct FaultAction {
  FaultAction() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): reads as a value
  FaultAction(DeviceCode reported) : kind(FaultKind::reports), reported_code(reported) {}
  // NOLINTNEXTLINE(google-explicit-constructor): reads as a value
  FaultAction(FaultKind kind_, double amount_ = 0.0) : kind(kind_), amount(amount_) {}

  bool is(FaultKind other) const { return kind == other; }
  // What the device says: ok also where it hides the fault.
  DeviceCode code() const;
  // Of kind late, else 0.
  Nanoseconds delay() const;

  FaultKind kind = FaultKind::none;
  DeviceCode reported_code = DeviceCode::ok;
  double amount = 0.0;  // amount_of(kind) says of what
};

struct Fault {
  FaultAction action = DeviceCode::io_error;
  int after_calls = 0;  // calls that still work; those count that the fault could spoil
  int times = 1;        // calls that it spoils; kForever: all
  Nanoseconds after_time{0};
  double share = 1.0;  // of the calls that it could spoil, drawn at random
  static constexpr int kForever = -1;
};

}  // namespace traygauge
