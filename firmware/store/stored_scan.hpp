// A scan as the store hands it out.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "firmware/base/scan_id.hpp"
#include "firmware/base/wall_clock.hpp"
#include "firmware/store/database.hpp"

namespace traygauge {

struct StoredScan {
  std::int64_t seq = 0;  // the order of arrival
  ScanId id;
  WallTime taken;     // by the station's clock
  WallTime received;  // by the hub's
  std::string status;
  std::optional<ScanId> supersedes;
  std::optional<ScanId> superseded_by;  // not booked: this one is
  bool is_corrected = false;
  bool is_wrong = false;  // a person marked it, or an item of it, as wrong
  std::string document;   // as it came
};

// The columns that read_stored_scan() expects, of `scans` joined with `documents`.
inline constexpr const char* kStoredScanColumns =
    "scans.seq, station, number, taken_ms, taken_synchronised, received_ms, received_synchronised, status, "
    "supersedes, superseded_by, is_corrected, is_wrong, body";
StoredScan read_stored_scan(const Statement& row);

// SQLite's integers are signed, numbers of scans are not.
std::int64_t stored_number(std::uint64_t number);
std::uint64_t scan_number(std::int64_t stored);

}  // namespace traygauge
