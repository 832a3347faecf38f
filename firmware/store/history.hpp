// Stored scans by filters, page by page.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/base/expected.hpp"
#include "firmware/store/stored_scan.hpp"

namespace traygauge {

// What is empty or none admits every scan. Texts are compared without regard to case.
struct HistoryFilter {
  std::optional<std::int64_t> from_ms;  // taken at or after
  std::optional<std::int64_t> to_ms;    // taken before
  std::string station;
  std::string status;
  std::string food;  // the whole name of a food, as corrected
  std::string text;  // part of id, tray, message, measured or corrected food
  std::optional<bool> is_corrected;
  std::optional<bool> is_wrong;
  bool with_superseded = true;
};

enum class HistoryOrder { newest_first, oldest_first };

// A place in the order of arrival. Scans that arrive or are deleted meanwhile neither repeat nor hide others.
struct HistoryCursor {
  std::int64_t seq = 0;
  friend bool operator==(const HistoryCursor&, const HistoryCursor&) = default;
};

// Opaque for clients. None where the text is no such cursor.
std::string history_cursor_text(const HistoryCursor& cursor);
std::optional<HistoryCursor> parse_history_cursor(std::string_view text);

struct HistoryPage {
  std::vector<StoredScan> scans;
  // Where to go on; none at the end. A page with a cursor may hold fewer scans than asked for, or none: a
  // call looks at kMaxWalk scans at most.
  std::optional<HistoryCursor> next;
};

class History {
 public:
  static constexpr std::int64_t kMaxWalk = 20'000;

  explicit History(Database& database, std::int64_t max_walk = kMaxWalk)
      : database_(database), max_walk_(max_walk) {}

  // In the order of arrival, which clocks that jump do not change.
  Expected<HistoryPage> page(const HistoryFilter& filter, std::size_t max_scans,
                             const std::optional<HistoryCursor>& after = std::nullopt,
                             HistoryOrder order = HistoryOrder::newest_first);
  // Oldest first, with a few scans in memory at a time, until `on_scan` returns false.
  Expected<void> for_each(const HistoryFilter& filter, const std::function<bool(const StoredScan&)>& on_scan);

  // Names of stations that have scans, the first `max` of the alphabet.
  Expected<std::vector<std::string>> stations(std::size_t max);
  // The first or the last `max` scans of a station by their numbers, with one scan in memory at a time.
  Expected<void> for_each_of(const std::string& station, HistoryOrder order, std::size_t max,
                             const std::function<void(const StoredScan&)>& on_scan);

 private:
  struct Range {
    std::int64_t first = 0;
    std::int64_t last = -1;
  };
  Expected<Range> stored_range();
  Expected<HistoryPage> read(const HistoryFilter& filter, const Range& walk, std::size_t max_scans,
                             HistoryOrder order);

  Database& database_;
  std::int64_t max_walk_;
};

}  // namespace traygauge
