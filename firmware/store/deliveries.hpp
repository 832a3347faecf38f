// Who still has to be told of which scan, and of which correction.
#pragma once

#include <chrono>
#include <compare>
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

// What is told first has the smaller key. The place is the seq of the scan that had arrived last; turn 0 is
// that scan itself, the others are the corrections that were made until the next one arrived.
struct DeliveryKey {
  std::int64_t place = 0;
  std::int64_t turn = 0;

  friend auto operator<=>(const DeliveryKey&, const DeliveryKey&) = default;
};

struct PendingDelivery {
  DeliveryKey key;
  ScanId id;
  int correction = 0;              // its number; 0: the scan is told
  std::int64_t correction_ms = 0;  // when it was made
  int attempts = 0;
  std::string last_failure;  // empty before the first attempt
};

struct DestinationState {
  std::string name;
  bool is_configured = false;
  std::int64_t pending = 0;
  std::optional<std::int64_t> oldest_received_ms;  // of the scans that wait, or whose corrections do
};

class Deliveries {
 public:
  // No wait between two attempts is longer. What seems due later than that was set by a clock that has jumped
  // since, and is due now.
  static constexpr std::chrono::hours kMaxWait{24};

  explicit Deliveries(Database& database) : database_(database) {}

  // Scans that are stored from now on, and corrections that are made, wait for these. What waits for others
  // goes on waiting: see abandon(). Returns those of the names that were not configured before.
  Expected<std::vector<std::string>> configure(std::span<const std::string> names);

  // Oldest first.
  Expected<std::vector<PendingDelivery>> due(std::string_view destination, std::int64_t now_ms,
                                             std::size_t max);
  // Those of these that wait no longer are passed over. One transaction: cheaper for many at a time.
  Expected<void> mark_delivered(std::string_view destination, std::span<const DeliveryKey> keys);
  Expected<void> mark_failed(std::string_view destination, const DeliveryKey& key, std::int64_t now_ms,
                             std::chrono::milliseconds wait, std::string_view why);

  // All destinations that are configured or for which something waits.
  Expected<std::vector<DestinationState>> states();
  // How many deliveries wait for this one; 0 where it is not known.
  Expected<std::int64_t> count_pending(std::string_view destination);
  // Names of the destinations that this scan, or a correction of it, waits for.
  Expected<std::vector<std::string>> waiting_for(std::int64_t seq);
  // Nobody will be told: for a destination that is gone. Returns how many deliveries waited.
  Expected<std::int64_t> abandon(std::string_view destination);

 private:
  Database& database_;
};

}  // namespace traygauge
