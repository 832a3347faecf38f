// Documents of scans as a station hands them over.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "firmware/base/scan_id.hpp"
#include "firmware/base/wall_clock.hpp"

namespace traygauge::test {

inline constexpr std::int64_t kMorningMs = 1795765200000;  // 2026-11-27T07:40:00Z

struct SampleScan {
  ScanId id{"kitchen", 1};
  std::int64_t taken_ms = kMorningMs;
  bool clock_synchronised = true;
  std::optional<ScanId> supersedes;
  std::string tray = "tray 12";
  std::string status = "ok";
  std::vector<std::string> foods = {"rice", "peas", "meatballs", "gravy"};  // an item each
  bool has_checks = true;  // false: an earlier program measured it, which told neither checks nor blur
  std::optional<double> scale_percent = 0.1234567890123456;  // none: no dish was checked
  double dish_height_mm = 0.0456789012345678;
  std::optional<double> glaze_height_mm;  // none: the glaze shows nothing, as most does
  std::array<std::optional<double>, 2> blur_px = {0.8712345678901234, 0.9112345678901234};
};

// Some 4 kB with four items.
std::string sample_document(const SampleScan& scan);
std::string sample_document(std::uint64_t number);

// By a clock that is synchronised.
WallTime at(std::int64_t unix_ms);

}  // namespace traygauge::test
