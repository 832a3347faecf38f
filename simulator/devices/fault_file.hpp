// A fault script in TOML; simulator/README.md describes it.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "simulator/devices/fault.hpp"
#include "simulator/devices/fault_script.hpp"

namespace traygauge {

struct FaultPlan {
  std::uint64_t seed = 0;
  std::array<std::vector<Fault>, kSimulatedDeviceCount> faults;  // in the order of SimulatedDevice

  const std::vector<Fault>& of(SimulatedDevice device) const {
    return faults[static_cast<std::size_t>(device)];
  }
  // Adds this device's faults to its script.
  void apply(SimulatedDevice device, FaultScript& script) const;
};

// Unknown keys, kinds that the device cannot play, and amounts that do not belong to a kind are errors.
// Throws InputError.
FaultPlan read_fault_file(const std::filesystem::path& file);

}  // namespace traygauge
