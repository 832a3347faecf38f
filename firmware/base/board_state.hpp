// What the board tells of its own health. A board that tells nothing of it is no fault.
#pragma once

#include <filesystem>
#include <optional>

namespace traygauge {

struct BoardState {
  std::optional<double> temperature_c;  // of its hottest part
  std::optional<bool> under_voltage;    // now, or at some time since the board started
};

// From the kernel's classes of devices, which lie in `classes`. Never fails.
BoardState read_board_state(const std::filesystem::path& classes = "/sys/class");

}  // namespace traygauge
