// How far `traygauge setup` got with a station file.
#pragma once

#include <filesystem>
#include <optional>

namespace traygauge {

struct SetupProgress {
  bool has_card = false;
  bool has_lens = false;  // of each camera
  bool has_arm = false;   // its move is calibrated, or there is none
};

// None where the file cannot be read.
std::optional<SetupProgress> read_setup_progress(const std::filesystem::path& station_file);

}  // namespace traygauge
