#include "firmware/store/open_store.hpp"

#include <cstdint>
#include <system_error>
#include <utility>

#include "firmware/store/damaged_files.hpp"
#include "firmware/store/schema.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;

// Where links lead: a damaged file is renamed in its own folder.
Expected<fs::path> real_path(const fs::path& file) {
  std::error_code error;
  fs::path real = fs::weakly_canonical(fs::absolute(file, error), error);
  if (error) return Failure{file.string() + ": " + error.message()};
  return real;
}

Expected<void> check_content(Database& database) {
  std::string found;
  Expected<void> checked = database.each("the file cannot be checked", "PRAGMA quick_check(1)",
                                         [&](const Statement& row) { found = row.text(0); });
  if (checked.ok() && found != "ok") checked = database.note_damage(found);
  return checked;
}

Expected<void> check_all(Database& database) {
  if (Expected<void> set = database.apply_settings(); !set.ok()) return set;
  if (Expected<void> checked = check_schema(database); !checked.ok()) return checked;
  if (Expected<void> checked = check_content(database); !checked.ok()) return checked;
  return check_tables(database);
}

Expected<void> make_ready(Database& database) {
  Expected<void> checked = check_all(database);
  if (!checked.ok() && database.was_senseless()) database.note_damage(checked.failure());
  if (!checked.ok()) return checked;
  const Expected<std::int64_t> migrated = migrate_schema(database);
  if (!migrated.ok()) return Failure{migrated.failure()};
  return database.reserve_journal();
}

// A database that was checked, or why not; `damage` says what is wrong with the file's content.
Expected<std::unique_ptr<Database>> open_checked(const fs::path& file, const char* vfs, std::string& damage) {
  Expected<std::unique_ptr<Database>> database = Database::open(file, vfs);
  if (!database.ok()) return database;
  const Expected<void> ready = make_ready(**database);
  if (ready.ok()) return database;
  damage = (*database)->damage();
  return Failure{ready.failure()};
}

Expected<void> make_room_for_new(const StoreOptions& options, const fs::path& file, const WallTime& now,
                                 const std::string& damage, std::vector<std::string>& notices) {
  const Expected<fs::path> aside = move_aside(file, now.unix_ms);
  if (!aside.ok()) return Failure{aside.failure()};
  notices.push_back("The store of results was damaged (" + damage + "). It is kept as " + aside->string() +
                    ", and a new one has begun: earlier results are missing here.");
  if (!options.max_damaged_files) return {};
  const auto deleted = limit_damaged_files(file, *options.max_damaged_files);
  if (!deleted.ok()) {
    notices.push_back(deleted.failure());
    return {};
  }
  for (const fs::path& gone : *deleted) {
    notices.push_back("The damaged store " + gone.string() + " was deleted, because no more than " +
                      std::to_string(*options.max_damaged_files) + " are to be kept.");
  }
  return {};
}

}  // namespace

Store::Store(FileLock lock, std::unique_ptr<ObservedVfs> vfs, std::unique_ptr<Database> database,
             FreeSpace free_space)
    : lock_(std::move(lock)),
      vfs_(std::move(vfs)),
      database_(std::move(database)),
      scans_(*database_),
      history_(*database_),
      corrections_(*database_, scans_),
      deliveries_(*database_),
      retention_(*database_, scans_, std::move(free_space)) {}

Expected<OpenedStore> open_store(const StoreOptions& options, const WallTime& now) {
  const Expected<fs::path> file = real_path(options.file);
  if (!file.ok()) return Failure{file.failure()};
  Expected<FileLock> lock = FileLock::take(file->string() + ".lock");
  if (!lock.ok()) return Failure{lock.failure()};
  Expected<std::unique_ptr<ObservedVfs>> vfs = ObservedVfs::create(options.observer);
  if (!vfs.ok()) return Failure{vfs.failure()};

  (*vfs)->watch_reads(options.on_progress);
  OpenedStore opened;
  std::string damage;
  Expected<std::unique_ptr<Database>> database = open_checked(*file, (*vfs)->name(), damage);
  if (!database.ok() && !damage.empty()) {
    const Expected<void> moved = make_room_for_new(options, *file, now, damage, opened.notices);
    if (!moved.ok()) return Failure{moved.failure()};
    database = open_checked(*file, (*vfs)->name(), damage);
  }
  if (!database.ok()) return Failure{database.failure()};
  opened.store =
      std::make_unique<Store>(std::move(*lock), std::move(*vfs), std::move(*database), options.free_space);
  Expected<std::vector<std::string>> added = opened.store->deliveries().configure(options.destinations);
  if (!added.ok()) return Failure{added.failure()};
  opened.new_destinations = std::move(*added);
  return opened;
}

}  // namespace traygauge
