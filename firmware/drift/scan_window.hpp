// The first or the last scans of a station: what they measured, and whether they count.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "firmware/drift/check_values.hpp"

namespace traygauge {

struct WindowScan {
  std::int64_t number = 0;       // of the scan, as the store orders them: see stored_number()
  std::int64_t received_ms = 0;  // by the hub's clock
  bool counts = true;            // false: superseded, or marked as wrong
  CheckValues values;
};

// Values in the order of their scans' numbers.
struct CheckSeries {
  std::vector<double> values;
  std::int64_t first_number = 0;
  std::int64_t last_number = 0;
};

// What it holds depends on the scans that were put, not on their order.
class ScanWindow {
 public:
  enum class End : std::uint8_t { first, last };

  ScanWindow(End end, std::size_t max_scans) : end_(end), max_scans_(max_scans) {}

  // A scan of the same number is replaced. With more than `max_scans`, the one farthest from the end leaves.
  void put(const WindowScan& scan);

  // Of the scans that count and have the value, those nearest to the end: `max_values` at most.
  CheckSeries series(WatchedCheck check, std::size_t max_values) const;

  // In the order of their numbers.
  const std::vector<WindowScan>& scans() const { return scans_; }

 private:
  End end_;
  std::size_t max_scans_;
  std::vector<WindowScan> scans_;
};

}  // namespace traygauge
