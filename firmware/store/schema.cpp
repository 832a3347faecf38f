#include "firmware/store/schema.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <set>
#include <string>
#include <string_view>

namespace traygauge {
namespace {

// What lists and filters read stands in `scans`, so that they need not read documents. `seq` counts in the
// order of arrival: clocks jump, it does not. Numbers of scans are unsigned in documents and signed here.
constexpr const char* kVersion1 = R"(
CREATE TABLE scans (
  seq INTEGER PRIMARY KEY,
  station TEXT NOT NULL,
  number INTEGER NOT NULL,
  taken_ms INTEGER NOT NULL,
  taken_synchronised INTEGER NOT NULL,
  received_ms INTEGER NOT NULL,
  received_synchronised INTEGER NOT NULL,
  status TEXT NOT NULL,
  supersedes INTEGER,
  superseded_by INTEGER,
  is_corrected INTEGER NOT NULL DEFAULT 0,
  is_wrong INTEGER NOT NULL DEFAULT 0,
  foods TEXT NOT NULL,
  words TEXT NOT NULL,
  document_bytes INTEGER NOT NULL
) STRICT;
CREATE UNIQUE INDEX scans_by_id ON scans (station, number);
CREATE INDEX scans_by_superseded ON scans (station, supersedes) WHERE supersedes IS NOT NULL;

CREATE TABLE documents (
  seq INTEGER PRIMARY KEY REFERENCES scans (seq) ON DELETE CASCADE,
  body TEXT NOT NULL
) STRICT;

CREATE TABLE corrections (
  seq INTEGER NOT NULL REFERENCES scans (seq) ON DELETE CASCADE,
  number INTEGER NOT NULL,
  made_ms INTEGER NOT NULL,
  made_synchronised INTEGER NOT NULL,
  author TEXT NOT NULL,
  reason TEXT NOT NULL,
  action TEXT NOT NULL,
  PRIMARY KEY (seq, number)
) STRICT, WITHOUT ROWID;

CREATE TABLE destinations (
  key INTEGER PRIMARY KEY,
  name TEXT NOT NULL UNIQUE,
  is_configured INTEGER NOT NULL
) STRICT;

CREATE TABLE deliveries (
  destination INTEGER NOT NULL REFERENCES destinations (key),
  seq INTEGER NOT NULL,
  attempts INTEGER NOT NULL DEFAULT 0,
  next_ms INTEGER NOT NULL DEFAULT 0,
  last_failure TEXT NOT NULL DEFAULT '',
  PRIMARY KEY (destination, seq)
) STRICT, WITHOUT ROWID;

CREATE TABLE set_aside (
  number INTEGER PRIMARY KEY,
  received_ms INTEGER NOT NULL,
  received_synchronised INTEGER NOT NULL,
  why TEXT NOT NULL,
  digest INTEGER NOT NULL,
  document BLOB NOT NULL
) STRICT;
CREATE INDEX set_aside_by_digest ON set_aside (digest);
)";

// Corrections are told, too. Events happen in the order of (place, turn): a scan's place is its seq and its
// turn 0; a correction has the place of the newest scan of its time, and the next turn there.
constexpr const char* kVersion2 = R"(
CREATE TABLE deliveries_of_events (
  destination INTEGER NOT NULL REFERENCES destinations (key),
  place INTEGER NOT NULL,
  turn INTEGER NOT NULL DEFAULT 0,
  seq INTEGER NOT NULL,
  correction INTEGER NOT NULL DEFAULT 0,
  attempts INTEGER NOT NULL DEFAULT 0,
  next_ms INTEGER NOT NULL DEFAULT 0,
  last_failure TEXT NOT NULL DEFAULT '',
  PRIMARY KEY (destination, place, turn)
) STRICT, WITHOUT ROWID;
INSERT INTO deliveries_of_events (destination, place, seq, attempts, next_ms, last_failure)
 SELECT destination, seq, seq, attempts, next_ms, last_failure FROM deliveries;
DROP TABLE deliveries;
ALTER TABLE deliveries_of_events RENAME TO deliveries;
CREATE INDEX deliveries_of_corrections ON deliveries (seq) WHERE correction > 0;
)";

constexpr auto kSteps = std::to_array<const char*>({kVersion1, kVersion2});

// Where SQLite's file format has them.
constexpr std::string_view kSqliteMagic = "SQLite format 3";
constexpr std::size_t kSqliteHeaderBytes = 100;
constexpr std::size_t kUserVersionAt = 60;
constexpr std::size_t kApplicationIdAt = 68;

std::int64_t big_endian_at(std::span<const char> bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (const char byte : bytes.subspan(at, sizeof value))
    value = value << 8 | static_cast<unsigned char>(byte);
  return static_cast<std::int32_t>(value);
}

Failure of_another_program(const std::filesystem::path& file) {
  return {file.string() + ": this is a database of another program. Name another file for the hub's store."};
}

Failure of_another_version(const std::filesystem::path& file, std::int64_t version,
                           std::span<const char* const> steps) {
  return {file.string() + ": the store has version " + std::to_string(version) +
          ", this program knows versions up to " + std::to_string(steps.size()) +
          ". Install the newer program again, or name another file for the hub's store."};
}

constexpr const char* kReadingTables = "the store's tables cannot be read";

Expected<void> run_step(Database& database, const char* step, std::int64_t version) {
  const std::string attempted = "the store cannot be brought to version " + std::to_string(version);
  return database.transaction(attempted, [&]() -> Expected<void> {
    if (Expected<void> done = database.run_script(attempted, step); !done.ok()) return done;
    const std::string marks = "PRAGMA application_id = " + std::to_string(kStoreApplicationId) +
                              "; PRAGMA user_version = " + std::to_string(version);
    return database.run_script(attempted, marks.c_str());
  });
}

Expected<std::set<std::string>> definitions(Database& database) {
  std::set<std::string> found;
  const Expected<void> read =
      database.each(kReadingTables,
                    "SELECT type || ' ' || name || ' ' || tbl_name || ' ' || sql FROM sqlite_schema"
                    " WHERE sql IS NOT NULL",
                    [&](const Statement& row) { found.insert(row.text(0)); });
  if (!read.ok()) return Failure{read.failure()};
  return found;
}

}  // namespace

std::span<const char* const> schema_steps() {
  return kSteps;
}

Expected<std::int64_t> peek_store_version(const std::filesystem::path& file,
                                          std::span<const char* const> steps) {
  std::array<char, kSqliteHeaderBytes> header{};
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    if (errno == ENOENT) return std::int64_t{0};
    return Failure{file.string() + ": the store cannot be opened: " + std::strerror(errno)};
  }
  stream.read(header.data(), header.size());
  if (stream.gcount() == 0) return std::int64_t{0};
  if (stream.gcount() < static_cast<std::streamsize>(header.size()) ||
      std::string_view(header.data(), kSqliteMagic.size()) != kSqliteMagic)
    return of_another_program(file);
  const std::int64_t version = big_endian_at(header, kUserVersionAt);
  if (big_endian_at(header, kApplicationIdAt) != kStoreApplicationId) return of_another_program(file);
  if (version >= 0 && version <= static_cast<std::int64_t>(steps.size())) return version;
  return of_another_version(file, version, steps);
}

Expected<void> check_schema(Database& database, std::span<const char* const> steps) {
  // The marks are read first: they need not understand tables that a newer program made.
  const auto application = database.integer(kReadingTables, "PRAGMA application_id");
  if (!application.ok()) return Failure{application.failure()};
  const auto version = database.integer(kReadingTables, "PRAGMA user_version");
  if (!version.ok()) return Failure{version.failure()};
  if (*application != kStoreApplicationId) {
    const auto tables = database.integer(kReadingTables, "SELECT count(*) FROM sqlite_schema");
    if (!tables.ok()) return Failure{tables.failure()};
    if (*application == 0 && *version == 0 && *tables == 0) return {};
    return of_another_program(database.file());
  }
  if (*version >= 0 && *version <= static_cast<std::int64_t>(steps.size())) return {};
  return of_another_version(database.file(), *version, steps);
}

Expected<void> check_tables(Database& database, std::span<const char* const> steps) {
  const auto version = database.integer(kReadingTables, "PRAGMA user_version");
  if (!version.ok()) return Failure{version.failure()};
  const Expected<std::unique_ptr<Database>> sample = Database::open_in_memory();
  if (!sample.ok()) return Failure{sample.failure()};
  for (const char* const step : steps.first(static_cast<std::size_t>(*version))) {
    if (Expected<void> made = (*sample)->run_script(kReadingTables, step); !made.ok()) return made;
  }
  const Expected<std::set<std::string>> expected = definitions(**sample);
  if (!expected.ok()) return Failure{expected.failure()};
  const Expected<std::set<std::string>> found = definitions(database);
  if (!found.ok()) return Failure{found.failure()};
  if (std::includes(found->begin(), found->end(), expected->begin(), expected->end())) return {};
  return database.note_damage("the definition of a table is not what version " + std::to_string(*version) +
                              " has");
}

Expected<std::int64_t> migrate_schema(Database& database, std::span<const char* const> steps) {
  auto before = database.integer(kReadingTables, "PRAGMA user_version");
  if (!before.ok()) return before;
  for (auto step = static_cast<std::size_t>(*before); step < steps.size(); ++step) {
    const Expected<void> done = run_step(database, steps[step], static_cast<std::int64_t>(step) + 1);
    if (!done.ok()) return Failure{done.failure()};
  }
  return before;
}

}  // namespace traygauge
