// The tables of the store, and how older ones become today's.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "firmware/store/database.hpp"

namespace traygauge {

// Marks an SQLite file as ours ("TRGY"); see `file --magic-file` and PRAGMA application_id.
inline constexpr std::int64_t kStoreApplicationId = 0x54524759;

// SQL, one step a version: the first makes version 1 of an empty file. Steps that were released never change.
// They make new tables instead of altering old ones, because check_tables() compares how tables were made.
std::span<const char* const> schema_steps();

// What a store's file says of itself in its first bytes, without SQLite and without a lock: a hub may be
// running on it. Returns its version, 0 where there is no file or an empty one; fails as check_schema() does,
// and where it cannot be read.
Expected<std::int64_t> peek_store_version(const std::filesystem::path& file,
                                          std::span<const char* const> steps = schema_steps());

// Fails where the file is another program's or of a newer version of this one.
Expected<void> check_schema(Database& database, std::span<const char* const> steps = schema_steps());

// Finds damage in the definitions of tables, which SQLite may take for another, sound definition: they have
// to be those that the steps up to the file's version make. Others beside them do no harm.
Expected<void> check_tables(Database& database, std::span<const char* const> steps = schema_steps());

// Brings a checked file to the newest version, step by step, each whole or not at all. Returns the version
// that it had, 0 of a new file.
Expected<std::int64_t> migrate_schema(Database& database,
                                      std::span<const char* const> steps = schema_steps());

}  // namespace traygauge
