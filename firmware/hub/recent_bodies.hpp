// What came last of scans, in memory alone: the oldest leave.
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <string>

#include "firmware/base/scan_id.hpp"

namespace traygauge {

struct RecentBodiesLimits {
  std::size_t max_count = 20;
  std::size_t max_bytes = 0;  // a single larger one is kept
};

// Used by one thread.
class RecentBodies {
 public:
  explicit RecentBodies(RecentBodiesLimits limits) : limits_(limits) {}

  // Takes the place of an earlier one of that scan.
  void put(const ScanId& id, std::string body);
  // Null where none is kept.
  std::shared_ptr<const std::string> find(const ScanId& id) const;

 private:
  struct Entry {
    ScanId id;
    std::shared_ptr<const std::string> body;
  };

  RecentBodiesLimits limits_;
  std::deque<Entry> entries_;  // the newest last
  std::size_t bytes_ = 0;
};

}  // namespace traygauge
