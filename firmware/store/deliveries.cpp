#include "firmware/store/deliveries.hpp"

#include <algorithm>
#include <iterator>

namespace traygauge {
namespace {

constexpr const char* kReadingDeliveries = "the deliveries cannot be read";
constexpr const char* kWritingDelivery = "a delivery cannot be noted";
constexpr std::size_t kMaxFailureBytes = 500;

// The beginning of UTF-8, without half a character at its end.
std::string_view shorten(std::string_view text) {
  std::size_t size = std::min(text.size(), kMaxFailureBytes);
  while (size < text.size() && size > 0 && (static_cast<unsigned char>(text[size]) & 0xc0U) == 0x80U) --size;
  return text.substr(0, size);
}

}  // namespace

Expected<std::vector<std::string>> Deliveries::configure(std::span<const std::string> names) {
  // Most starts change nothing and write nothing.
  std::vector<std::string> before;
  const Expected<void> read =
      database_.each(kReadingDeliveries, "SELECT name FROM destinations WHERE is_configured ORDER BY name",
                     [&](const Statement& row) { before.push_back(row.text(0)); });
  if (!read.ok()) return Failure{read.failure()};
  std::vector<std::string> wanted(names.begin(), names.end());
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  std::vector<std::string> added;
  if (wanted == before) return added;
  std::set_difference(wanted.begin(), wanted.end(), before.begin(), before.end(), std::back_inserter(added));
  const Expected<void> written = database_.transaction(kWritingDelivery, [&]() -> Expected<void> {
    Expected<void> done = database_.execute(kWritingDelivery, "UPDATE destinations SET is_configured = 0");
    for (const std::string& name : wanted) {
      if (!done.ok()) break;
      done = database_.execute(kWritingDelivery,
                               "INSERT INTO destinations (name, is_configured) VALUES (?1, 1)"
                               " ON CONFLICT (name) DO UPDATE SET is_configured = 1",
                               name);
    }
    return done;
  });
  if (!written.ok()) return Failure{written.failure()};
  return added;
}

Expected<std::vector<PendingDelivery>> Deliveries::due(std::string_view destination, std::int64_t now_ms,
                                                       std::size_t max) {
  std::vector<PendingDelivery> pending;
  const std::int64_t max_wait_ms = std::chrono::milliseconds(kMaxWait).count();
  const Expected<void> read = database_.each(
      kReadingDeliveries,
      "SELECT place, turn, station, scans.number, correction, coalesce(made_ms, 0), attempts,"
      " last_failure FROM deliveries JOIN scans USING (seq)"
      " LEFT JOIN corrections ON corrections.seq = deliveries.seq AND corrections.number = correction"
      " WHERE destination = (SELECT key FROM destinations WHERE name = ?1)"
      " AND next_ms NOT BETWEEN ?2 + 1 AND ?2 + ?3 ORDER BY place, turn LIMIT ?4",
      [&](const Statement& row) {
        pending.push_back({{row.integer(0), row.integer(1)},
                           {row.text(2), static_cast<std::uint64_t>(row.integer(3))},
                           static_cast<int>(row.integer(4)),
                           row.integer(5),
                           static_cast<int>(row.integer(6)),
                           row.text(7)});
      },
      destination, now_ms, max_wait_ms, static_cast<std::int64_t>(max));
  if (!read.ok()) return Failure{read.failure()};
  return pending;
}

Expected<void> Deliveries::mark_delivered(std::string_view destination, std::span<const DeliveryKey> keys) {
  return database_.transaction(kWritingDelivery, [&]() -> Expected<void> {
    Expected<void> done;
    for (const DeliveryKey& key : keys) {
      if (!done.ok()) break;
      done = database_.execute(kWritingDelivery,
                               "DELETE FROM deliveries WHERE place = ?2 AND turn = ?3"
                               " AND destination = (SELECT key FROM destinations WHERE name = ?1)",
                               destination, key.place, key.turn);
    }
    return done;
  });
}

Expected<void> Deliveries::mark_failed(std::string_view destination, const DeliveryKey& key,
                                       std::int64_t now_ms, std::chrono::milliseconds wait,
                                       std::string_view why) {
  const std::chrono::milliseconds bounded =
      std::clamp(wait, std::chrono::milliseconds(0), std::chrono::milliseconds(kMaxWait));
  return database_.transaction(kWritingDelivery, [&] {
    return database_.execute(kWritingDelivery,
                             "UPDATE deliveries SET attempts = attempts + 1, next_ms = ?4, last_failure = ?5"
                             " WHERE place = ?2 AND turn = ?3"
                             " AND destination = (SELECT key FROM destinations WHERE name = ?1)",
                             destination, key.place, key.turn, now_ms + bounded.count(), shorten(why));
  });
}

Expected<std::vector<DestinationState>> Deliveries::states() {
  std::vector<DestinationState> states;
  const Expected<void> read = database_.each(
      kReadingDeliveries,
      "SELECT name, is_configured, (SELECT count(*) FROM deliveries WHERE destination = key) AS pending,"
      " (SELECT received_ms FROM scans WHERE seq ="
      "  (SELECT seq FROM deliveries WHERE destination = key ORDER BY place, turn LIMIT 1))"
      " FROM destinations WHERE is_configured OR pending > 0 ORDER BY name",
      [&](const Statement& row) {
        states.push_back({row.text(0), row.integer(1) != 0, row.integer(2), row.optional_integer(3)});
      });
  if (!read.ok()) return Failure{read.failure()};
  return states;
}

Expected<std::int64_t> Deliveries::count_pending(std::string_view destination) {
  return database_.integer(kReadingDeliveries,
                           "SELECT count(*) FROM deliveries"
                           " WHERE destination = (SELECT key FROM destinations WHERE name = ?1)",
                           destination);
}

Expected<std::vector<std::string>> Deliveries::waiting_for(std::int64_t seq) {
  std::vector<std::string> names;
  const Expected<void> read = database_.each(
      kReadingDeliveries,
      "SELECT name FROM destinations WHERE EXISTS"
      " (SELECT 1 FROM deliveries WHERE destination = key AND place = ?1 AND turn = 0) OR EXISTS"
      " (SELECT 1 FROM deliveries WHERE destination = key AND seq = ?1 AND correction > 0) ORDER BY name",
      [&](const Statement& row) { names.push_back(row.text(0)); }, seq);
  if (!read.ok()) return Failure{read.failure()};
  return names;
}

Expected<std::int64_t> Deliveries::abandon(std::string_view destination) {
  std::int64_t abandoned = 0;
  const Expected<void> done = database_.transaction(kWritingDelivery, [&]() -> Expected<void> {
    Expected<void> deleted = database_.execute(kWritingDelivery,
                                               "DELETE FROM deliveries WHERE destination ="
                                               " (SELECT key FROM destinations WHERE name = ?1)",
                                               destination);
    abandoned = database_.changed_rows();
    return deleted;
  });
  if (!done.ok()) return Failure{done.failure()};
  return abandoned;
}

}  // namespace traygauge
