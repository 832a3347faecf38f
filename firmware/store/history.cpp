#include "firmware/store/history.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>

#include "firmware/store/search_text.hpp"

namespace traygauge {
namespace {

constexpr const char* kReadingHistory = "the history cannot be read";
constexpr char kCursorVersion = 'a';
constexpr int kCursorBase = 36;

std::string page_sql(HistoryOrder order) {
  return std::string("SELECT ") + kStoredScanColumns +
         " FROM scans CROSS JOIN documents USING (seq) WHERE scans.seq BETWEEN ?1 AND ?2"
         " AND (?3 IS NULL OR taken_ms >= ?3) AND (?4 IS NULL OR taken_ms < ?4)"
         " AND (?5 = '' OR station = ?5) AND (?6 = '' OR status = ?6)"
         " AND (?7 = '' OR instr(foods, char(10) || ?7 || char(10)) > 0)"
         " AND (?8 = '' OR instr(words, ?8) > 0 OR instr(foods, ?8) > 0)"
         " AND (?9 IS NULL OR is_corrected = ?9) AND (?10 IS NULL OR is_wrong = ?10)"
         " AND (?11 OR superseded_by IS NULL)"
         " ORDER BY scans.seq " +
         (order == HistoryOrder::newest_first ? "DESC" : "ASC") + " LIMIT ?12";
}

// In the order of the index scans_by_id: what is read does not depend on how much is stored.
std::string station_sql(HistoryOrder order) {
  return std::string("SELECT ") + kStoredScanColumns +
         " FROM scans CROSS JOIN documents USING (seq) WHERE station = ?1 ORDER BY number " +
         (order == HistoryOrder::newest_first ? "DESC" : "ASC") + " LIMIT ?2";
}

// A step in the same index for each station, whatever the number of scans.
constexpr const char* kStationsSql =
    "WITH RECURSIVE names (name) AS (SELECT min(station) FROM scans UNION ALL"
    " SELECT (SELECT min(station) FROM scans WHERE station > name) FROM names WHERE name IS NOT NULL)"
    " SELECT name FROM names WHERE name IS NOT NULL LIMIT ?1";

}  // namespace

std::string history_cursor_text(const HistoryCursor& cursor) {
  std::array<char, 24> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), cursor.seq, kCursorBase);
  return kCursorVersion + std::string(digits.data(), end.ptr);
}

std::optional<HistoryCursor> parse_history_cursor(std::string_view text) {
  if (text.size() < 2 || text.front() != kCursorVersion) return std::nullopt;
  HistoryCursor cursor;
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data() + 1, end, cursor.seq, kCursorBase);
  if (read.ec != std::errc() || read.ptr != end || cursor.seq < 0) return std::nullopt;
  return cursor;
}

Expected<HistoryPage> History::page(const HistoryFilter& filter, std::size_t max_scans,
                                    const std::optional<HistoryCursor>& after, HistoryOrder order) {
  const Expected<Range> stored = stored_range();
  if (!stored.ok()) return Failure{stored.failure()};
  Range walk = *stored;
  const bool is_down = order == HistoryOrder::newest_first;
  if (is_down) {
    if (after) walk.last = std::min(walk.last, after->seq - 1);
    walk.first = std::max(walk.first, walk.last - max_walk_ + 1);
  } else {
    constexpr std::int64_t kLast = std::numeric_limits<std::int64_t>::max();
    if (after && after->seq == kLast) return HistoryPage{};
    if (after) walk.first = std::max(walk.first, after->seq + 1);
    walk.last = walk.last - walk.first < max_walk_ ? walk.last : walk.first + max_walk_ - 1;
  }
  if (walk.first > walk.last || max_scans == 0) return HistoryPage{};
  Expected<HistoryPage> page = read(filter, walk, max_scans, order);
  if (!page.ok()) return page;
  const bool is_full = page->scans.size() == max_scans;
  const std::int64_t reached = is_full ? page->scans.back().seq : is_down ? walk.first : walk.last;
  if (is_down ? reached > stored->first : reached < stored->last) page->next = HistoryCursor{reached};
  return page;
}

Expected<History::Range> History::stored_range() {
  Range range;
  const Expected<void> read = database_.each(
      kReadingHistory,
      "SELECT ifnull((SELECT min(seq) FROM scans), 0), ifnull((SELECT max(seq) FROM scans), -1)",
      [&](const Statement& row) {
        range = {row.integer(0), row.integer(1)};
      });
  if (!read.ok()) return Failure{read.failure()};
  return range;
}

Expected<HistoryPage> History::read(const HistoryFilter& filter, const Range& walk, std::size_t max_scans,
                                    HistoryOrder order) {
  HistoryPage page;
  const Expected<void> done = database_.each(
      kReadingHistory, page_sql(order).c_str(),
      [&](const Statement& row) { page.scans.push_back(read_stored_scan(row)); }, walk.first, walk.last,
      filter.from_ms, filter.to_ms, filter.station, filter.status, fold_case(filter.food),
      fold_case(filter.text), filter.is_corrected, filter.is_wrong, filter.with_superseded,
      static_cast<std::int64_t>(max_scans));
  if (!done.ok()) return Failure{done.failure()};
  return page;
}

Expected<void> History::for_each(const HistoryFilter& filter,
                                 const std::function<bool(const StoredScan&)>& on_scan) {
  constexpr std::size_t kScansAtATime = 100;
  std::optional<HistoryCursor> cursor;
  do {
    const Expected<HistoryPage> read = page(filter, kScansAtATime, cursor, HistoryOrder::oldest_first);
    if (!read.ok()) return Failure{read.failure()};
    for (const StoredScan& scan : read->scans) {
      if (!on_scan(scan)) return {};
    }
    cursor = read->next;
  } while (cursor);
  return {};
}

Expected<std::vector<std::string>> History::stations(std::size_t max) {
  std::vector<std::string> names;
  const Expected<void> read = database_.each(
      kReadingHistory, kStationsSql, [&](const Statement& row) { names.push_back(row.text(0)); },
      static_cast<std::int64_t>(max));
  if (!read.ok()) return Failure{read.failure()};
  return names;
}

Expected<void> History::for_each_of(const std::string& station, HistoryOrder order, std::size_t max,
                                    const std::function<void(const StoredScan&)>& on_scan) {
  return database_.each(
      kReadingHistory, station_sql(order).c_str(),
      [&](const Statement& row) { on_scan(read_stored_scan(row)); }, station, static_cast<std::int64_t>(max));
}

}  // namespace traygauge
