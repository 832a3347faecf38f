#include "firmware/store/stored_scan.hpp"

namespace traygauge {

std::int64_t stored_number(std::uint64_t number) {
  return static_cast<std::int64_t>(number);
}

std::uint64_t scan_number(std::int64_t stored) {
  return static_cast<std::uint64_t>(stored);
}

StoredScan read_stored_scan(const Statement& row) {
  StoredScan scan;
  scan.seq = row.integer(0);
  scan.id = {row.text(1), scan_number(row.integer(2))};
  const auto id_at = [&](int column) -> std::optional<ScanId> {
    if (row.is_null(column)) return std::nullopt;
    return ScanId{scan.id.station, scan_number(row.integer(column))};
  };
  scan.taken = {row.integer(3), row.integer(4) != 0};
  scan.received = {row.integer(5), row.integer(6) != 0};
  scan.status = row.text(7);
  scan.supersedes = id_at(8);
  scan.superseded_by = id_at(9);
  scan.is_corrected = row.integer(10) != 0;
  scan.is_wrong = row.integer(11) != 0;
  scan.document = row.text(12);
  return scan;
}

}  // namespace traygauge
