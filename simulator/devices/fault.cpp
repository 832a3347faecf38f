#include "simulator/devices/fault.hpp"

#include <cmath>

namespace traygauge {
namespace {

struct KindText {
  const char* name;
  FaultAmount amount;
};

// In the order of FaultKind. Beyond these limits nothing new happens.
constexpr auto kKinds = std::to_array<KindText>({
    {"none", {}},
    {"reports", {}},
    {"off", {}},
    {"stuck", {}},
    {"stale", {}},
    {"late", {"by_ms", 1.0, 3.6e6}},
    {"garbage", {}},
    {"torn", {}},
    {"mixed", {"row_fraction", -0.99, 0.99}},
    {"wrong_size", {"side_fraction", 0.01, 0.99}},
    {"bounce", {"edges", 2.0, 1000.0}},
    {"wrong_angle", {"by_deg", -90.0, 90.0}},
    {"stall", {}},
    {"silent_stall", {}},
    {"slow", {"factor", 1.0, 1000.0}},
});
static_assert(kKinds.size() == kFaultKindCount);

using enum FaultKind;
constexpr auto kCamera = std::to_array({off, stuck, stale, late, garbage, torn, mixed, wrong_size});
constexpr auto kButton = std::to_array({off, stuck, late, bounce});
constexpr auto kArm = std::to_array({off, stuck, wrong_angle, stall, silent_stall, slow});
constexpr auto kLamp = std::to_array({off, stuck});
constexpr auto kClock = std::to_array({late, slow});

}  // namespace

const char* name(SimulatedDevice device) {
  static constexpr auto kNames = std::to_array<const char*>({"camera", "button", "arm", "lamp", "clock"});
  static_assert(kNames.size() == kSimulatedDeviceCount);
  return kNames[static_cast<std::size_t>(device)];
}

const char* name(FaultKind kind) {
  return kKinds[static_cast<std::size_t>(kind)].name;
}

FaultKinds set_of(std::initializer_list<FaultKind> kinds) {
  FaultKinds set;
  for (const FaultKind kind : kinds) set.set(static_cast<std::size_t>(kind));
  return set;
}

const FaultAmount* amount_of(FaultKind kind) {
  const FaultAmount& amount = kKinds[static_cast<std::size_t>(kind)].amount;
  return amount.key != nullptr ? &amount : nullptr;
}

std::span<const FaultKind> kinds_of(SimulatedDevice device) {
  static constexpr std::array<std::span<const FaultKind>, kSimulatedDeviceCount> kKindsOf = {
      kCamera, kButton, kArm, kLamp, kClock};
  return kKindsOf[static_cast<std::size_t>(device)];
}

DeviceCode FaultAction::code() const {
  switch (kind) {
    case reports:
      return reported_code;
    case off:
      return DeviceCode::device_gone;
    case stale:
      return DeviceCode::stale_frame;
    case torn:
      return DeviceCode::torn_frame;
    case stall:
      return DeviceCode::stalled;
    default:
      return DeviceCode::ok;
  }
}

Nanoseconds FaultAction::delay() const {
  if (kind != late) return Nanoseconds::zero();
  return std::chrono::round<Nanoseconds>(std::chrono::duration<double, std::milli>(amount));
}

}  // namespace traygauge
