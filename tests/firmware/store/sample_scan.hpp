// Documents of scans as a station hands them over.
#pragma once

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
};

// Some 3 kB with four items.
std::string sample_document(const SampleScan& scan);
std::string sample_document(std::uint64_t number);

// By a clock that is synchronised.
WallTime at(std::int64_t unix_ms);

}  // namespace traygauge::test
