// Who still has to be told of which scan.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/base/expected.hpp"
#include "firmware/base/scan_id.hpp"
#include "firmware/store/database.hpp"

namespace traygauge {

struct PendingDelivery {
  std::int64_t seq = 0;
  ScanId id;
  std::string document;
  int attempts = 0;
  std::string last_failure;  // empty before the first attempt
};

struct DestinationState {
  std::string name;
  bool is_configured = false;
  std::int64_t pending = 0;
  std::optional<std::int64_t> oldest_received_ms;  // of what waits
};

class Deliveries {
 public:
  // No wait between two attempts is longer. What seems due later than that was set by a clock that has jumped
  // since, and is due now.
  static constexpr std::chrono::hours kMaxWait{24};

  explicit Deliveries(Database& database) : database_(database) {}

  // Scans that are stored from now on wait for these. What waits for others goes on waiting: see abandon().
  Expected<void> configure(std::span<const std::string> names);

  // Oldest first.
  Expected<std::vector<PendingDelivery>> due(std::string_view destination, std::int64_t now_ms,
                                             std::size_t max);
  // Those of these that wait no longer are passed over. One transaction: cheaper for many at a time.
  Expected<void> mark_delivered(std::string_view destination, std::span<const std::int64_t> seqs);
  Expected<void> mark_failed(std::string_view destination, std::int64_t seq, std::int64_t now_ms,
                             std::chrono::milliseconds wait, std::string_view why);

  // All destinations that are configured or for which something waits.
  Expected<std::vector<DestinationState>> states();
  // Names of the destinations that this scan waits for.
  Expected<std::vector<std::string>> waiting_for(std::int64_t seq);
  // Nobody will be told: for a destination that is gone. Returns how many scans waited.
  Expected<std::int64_t> abandon(std::string_view destination);

 private:
  Database& database_;
};

}  // namespace traygauge
