#include "firmware/collect/sqlite_store.hpp"

#include <utility>

namespace traygauge {
namespace {

constexpr const char* kWriting = "results cannot be stored";
constexpr std::int64_t kApplication = 0x54474331;  // "TGC1"
constexpr std::int64_t kVersion = 1;

// Who starts from this adds columns and reads `body` with SQLite's JSON functions.
constexpr const char* kTables =
    "CREATE TABLE events (seq INTEGER PRIMARY KEY, id TEXT NOT NULL UNIQUE, hub TEXT NOT NULL,"
    " station TEXT NOT NULL, kind TEXT NOT NULL, taken_at TEXT NOT NULL, received_ms INTEGER NOT NULL,"
    " body TEXT NOT NULL);"
    "CREATE TABLE twins (id TEXT NOT NULL, hub TEXT NOT NULL, taken_at TEXT NOT NULL,"
    " received_ms INTEGER NOT NULL, body TEXT NOT NULL, UNIQUE (id, hub, taken_at));"
    "PRAGMA application_id = 1413956401;"
    "PRAGMA user_version = 1;";

}  // namespace

Expected<std::unique_ptr<CollectedStore>> SqliteStore::open(const std::filesystem::path& file) {
  Expected<std::unique_ptr<Database>> database = Database::open(file, "unix");
  if (!database.ok()) return Failure{database.failure()};
  if (const Expected<void> set = (*database)->apply_settings(); !set.ok()) return Failure{set.failure()};
  std::unique_ptr<SqliteStore> store(new SqliteStore(std::move(*database)));
  if (const Expected<void> made = store->prepare_tables(); !made.ok()) return Failure{made.failure()};
  return std::unique_ptr<CollectedStore>(std::move(store));
}

Expected<void> SqliteStore::prepare_tables() {
  constexpr const char* kReading = "the file cannot be read";
  const auto tables = database_->integer(kReading, "SELECT count(*) FROM sqlite_schema");
  if (!tables.ok()) return Failure{tables.failure()};
  if (*tables == 0)
    return database_->transaction(kWriting, [this] { return database_->run_script(kWriting, kTables); });
  const auto application = database_->integer(kReading, "PRAGMA application_id");
  if (!application.ok()) return Failure{application.failure()};
  const std::string file = database_->file().string();
  if (*application != kApplication)
    return Failure{file +
                   ": expected a collector's file or none, found another program's; name another file."};
  const auto version = database_->integer(kReading, "PRAGMA user_version");
  if (!version.ok()) return Failure{version.failure()};
  if (*version == kVersion) return {};
  return Failure{file + ": expected version " + std::to_string(kVersion) + ", found " +
                 std::to_string(*version) + "; install the newer program again."};
}

Expected<StoredBatch> SqliteStore::put(std::span<const CollectedEvent> events, std::int64_t received_ms) {
  StoredBatch batch;
  const Expected<void> done = database_->transaction(kWriting, [&]() -> Expected<void> {
    batch = {};
    for (const CollectedEvent& event : events) {
      if (Expected<void> put = put_one(event, received_ms, batch); !put.ok()) return put;
    }
    return {};
  });
  if (!done.ok()) return Failure{done.failure()};
  return batch;
}

Expected<void> SqliteStore::put_one(const CollectedEvent& event, std::int64_t received_ms,
                                    StoredBatch& batch) {
  Expected<void> done = database_->execute(
      kWriting,
      "INSERT INTO events (id, hub, station, kind, taken_at, received_ms, body)"
      " VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7) ON CONFLICT (id) DO NOTHING",
      event.id, event.hub, event.station, event.kind, event.taken_at, received_ms, event.body);
  if (!done.ok()) return done;
  if (database_->changed_rows() == 1) {
    ++batch.stored;
    return {};
  }
  const auto same =
      database_->integer(kWriting, "SELECT count(*) FROM events WHERE id = ?1 AND hub = ?2 AND taken_at = ?3",
                         event.id, event.hub, event.taken_at);
  if (!same.ok()) return Failure{same.failure()};
  if (*same == 1) {
    ++batch.repeated;
    return {};
  }
  done = database_->execute(
      kWriting,
      "INSERT INTO twins (id, hub, taken_at, received_ms, body) VALUES (?1, ?2, ?3, ?4, ?5)"
      " ON CONFLICT DO NOTHING",
      event.id, event.hub, event.taken_at, received_ms, event.body);
  if (!done.ok()) return done;
  if (database_->changed_rows() == 1) {
    batch.twins.push_back(event.id);
  } else {
    ++batch.repeated;
  }
  return {};
}

Expected<std::int64_t> SqliteStore::count() {
  return database_->integer("results cannot be counted", "SELECT count(*) FROM events");
}

}  // namespace traygauge
