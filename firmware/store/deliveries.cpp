#include "firmware/store/deliveries.hpp"

#include <algorithm>

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

Expected<void> Deliveries::configure(std::span<const std::string> names) {
  // Most starts change nothing and write nothing.
  std::vector<std::string> before;
  Expected<void> read =
      database_.each(kReadingDeliveries, "SELECT name FROM destinations WHERE is_configured ORDER BY name",
                     [&](const Statement& row) { before.push_back(row.text(0)); });
  if (!read.ok()) return read;
  std::vector<std::string> wanted(names.begin(), names.end());
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  if (wanted == before) return {};
  return database_.transaction(kWritingDelivery, [&]() -> Expected<void> {
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
}

Expected<std::vector<PendingDelivery>> Deliveries::due(std::string_view destination, std::int64_t now_ms,
                                                       std::size_t max) {
  std::vector<PendingDelivery> pending;
  const std::int64_t max_wait_ms = std::chrono::milliseconds(kMaxWait).count();
  const Expected<void> read = database_.each(
      kReadingDeliveries,
      "SELECT seq, station, number, body, attempts, last_failure FROM deliveries"
      " JOIN scans USING (seq) JOIN documents USING (seq)"
      " WHERE destination = (SELECT key FROM destinations WHERE name = ?1)"
      " AND next_ms NOT BETWEEN ?2 + 1 AND ?2 + ?3 ORDER BY deliveries.seq LIMIT ?4",
      [&](const Statement& row) {
        pending.push_back({row.integer(0),
                           {row.text(1), static_cast<std::uint64_t>(row.integer(2))},
                           row.text(3),
                           static_cast<int>(row.integer(4)),
                           row.text(5)});
      },
      destination, now_ms, max_wait_ms, static_cast<std::int64_t>(max));
  if (!read.ok()) return Failure{read.failure()};
  return pending;
}

Expected<void> Deliveries::mark_delivered(std::string_view destination, std::span<const std::int64_t> seqs) {
  return database_.transaction(kWritingDelivery, [&]() -> Expected<void> {
    Expected<void> done;
    for (const std::int64_t seq : seqs) {
      if (!done.ok()) break;
      done = database_.execute(kWritingDelivery,
                               "DELETE FROM deliveries WHERE seq = ?2"
                               " AND destination = (SELECT key FROM destinations WHERE name = ?1)",
                               destination, seq);
    }
    return done;
  });
}

Expected<void> Deliveries::mark_failed(std::string_view destination, std::int64_t seq, std::int64_t now_ms,
                                       std::chrono::milliseconds wait, std::string_view why) {
  const std::chrono::milliseconds bounded =
      std::clamp(wait, std::chrono::milliseconds(0), std::chrono::milliseconds(kMaxWait));
  return database_.transaction(kWritingDelivery, [&] {
    return database_.execute(kWritingDelivery,
                             "UPDATE deliveries SET attempts = attempts + 1, next_ms = ?3, last_failure = ?4"
                             " WHERE seq = ?2"
                             " AND destination = (SELECT key FROM destinations WHERE name = ?1)",
                             destination, seq, now_ms + bounded.count(), shorten(why));
  });
}

Expected<std::vector<DestinationState>> Deliveries::states() {
  std::vector<DestinationState> states;
  const Expected<void> read = database_.each(
      kReadingDeliveries,
      "SELECT name, is_configured, (SELECT count(*) FROM deliveries WHERE destination = key) AS pending,"
      " (SELECT received_ms FROM scans WHERE seq ="
      "  (SELECT min(seq) FROM deliveries WHERE destination = key))"
      " FROM destinations WHERE is_configured OR pending > 0 ORDER BY name",
      [&](const Statement& row) {
        states.push_back({row.text(0), row.integer(1) != 0, row.integer(2), row.optional_integer(3)});
      });
  if (!read.ok()) return Failure{read.failure()};
  return states;
}

Expected<std::vector<std::string>> Deliveries::waiting_for(std::int64_t seq) {
  std::vector<std::string> names;
  const Expected<void> read = database_.each(
      kReadingDeliveries,
      "SELECT name FROM destinations WHERE EXISTS"
      " (SELECT 1 FROM deliveries WHERE destination = key AND seq = ?1) ORDER BY name",
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
