#include "firmware/store/database.hpp"

#include <sqlite3.h>

#include <cstring>

#include "firmware/store/persistent_journal.hpp"

namespace traygauge {
namespace {

constexpr int kBusyMs = 2000;
constexpr int kMaxRowBytes = 16 * 1024 * 1024;

// The rollback journal stays beside the file, and zeroes written over its header commit. SQLite syncs these
// zeroes. When it removes the journal instead (its default), it does not sync the folder, and a power cut
// brings back the journal and with it the state before: tests/firmware/store/crash_test.cpp shows this.
// Write-ahead logging is avoided because the versions in Debian 12 and 13 can damage a file by it.
//
// Small pages, because a change writes each touched page to the journal and to the file: by budget_test.cpp a
// scan costs 19 kB in 12 blocks of 4,096 bytes, with pages of 4,096 bytes 56 kB in 16 blocks.
constexpr const char* kSettings =
    "PRAGMA locking_mode = EXCLUSIVE;"
    "PRAGMA page_size = 1024;"
    "PRAGMA auto_vacuum = NONE;"
    "PRAGMA journal_size_limit = 1048576;"
    "PRAGMA synchronous = FULL;"
    "PRAGMA mmap_size = 0;"
    "PRAGMA cache_size = -1024;"  // KiB
    "PRAGMA temp_store = MEMORY;"
    "PRAGMA secure_delete = OFF;"
    "PRAGMA cell_size_check = ON;"
    "PRAGMA trusted_schema = OFF;"
    "PRAGMA foreign_keys = ON;";

const char* advice(int result) {
  switch (result & 0xff) {
    case SQLITE_FULL:
      return ". Free some space on this disk.";
    case SQLITE_READONLY:
    case SQLITE_PERM:
      return ". Make the file and its folder writable for this user.";
    case SQLITE_CANTOPEN:
      return ". Check that the folder exists and that this user may write in it.";
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return ". Another program uses this file: end it.";
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB:
      return ". Start the hub anew: it puts the damaged file aside.";
    case SQLITE_IOERR:
      return ". Check the disk and its cable.";
    default:
      return ".";
  }
}

}  // namespace

void Statement::Finalize::operator()(sqlite3_stmt* statement) const {
  sqlite3_finalize(statement);
}

Statement::Statement(Database& database, std::string attempted, sqlite3_stmt* handle)
    : database_(&database), attempted_(std::move(attempted)), handle_(handle) {}

void Statement::note(int result) {
  if (bind_result_ == SQLITE_OK) bind_result_ = result;
}

void Statement::bind(int index, std::int64_t value) {
  note(sqlite3_bind_int64(handle_.get(), index, value));
}

void Statement::bind(int index, double value) {
  note(sqlite3_bind_double(handle_.get(), index, value));
}

void Statement::bind(int index, std::string_view text) {
  note(sqlite3_bind_text64(handle_.get(), index, text.data() == nullptr ? "" : text.data(), text.size(),
                           SQLITE_TRANSIENT, SQLITE_UTF8));
}

void Statement::bind(int index, std::nullopt_t) {
  note(sqlite3_bind_null(handle_.get(), index));
}

void Statement::bind_bytes(int index, std::string_view bytes) {
  note(sqlite3_bind_blob64(handle_.get(), index, bytes.data() == nullptr ? "" : bytes.data(), bytes.size(),
                           SQLITE_TRANSIENT));
}

Expected<bool> Statement::step() {
  const int result = bind_result_ != SQLITE_OK ? bind_result_ : sqlite3_step(handle_.get());
  if (result == SQLITE_ROW) return true;
  if (result == SQLITE_DONE) return false;
  return database_->failure(attempted_, result);
}

bool Statement::is_null(int column) const {
  return sqlite3_column_type(handle_.get(), column) == SQLITE_NULL;
}

std::int64_t Statement::integer(int column) const {
  return sqlite3_column_int64(handle_.get(), column);
}

double Statement::real(int column) const {
  return sqlite3_column_double(handle_.get(), column);
}

std::string Statement::text(int column) const {
  const void* const bytes = sqlite3_column_blob(handle_.get(), column);
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(handle_.get(), column));
  return bytes == nullptr ? std::string() : std::string(static_cast<const char*>(bytes), size);
}

std::optional<std::int64_t> Statement::optional_integer(int column) const {
  return is_null(column) ? std::nullopt : std::optional(integer(column));
}

void Database::Close::operator()(sqlite3* handle) const {
  sqlite3_close_v2(handle);
}

Database::Database(std::filesystem::path file, const char* vfs_name, sqlite3* handle)
    : file_(std::move(file)), vfs_name_(vfs_name), handle_(handle) {}

Expected<std::unique_ptr<Database>> Database::open(const std::filesystem::path& file, const char* vfs_name) {
  std::error_code error;
  // SQLite would read a name such as "file:x" as an address.
  std::filesystem::path full = std::filesystem::absolute(file, error);
  if (error) return Failure{file.string() + ": " + error.message()};
  sqlite3* handle = nullptr;
  const int result = sqlite3_open_v2(
      full.c_str(), &handle,
      SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_NOMUTEX | SQLITE_OPEN_EXRESCODE, vfs_name);
  std::unique_ptr<Database> database(new Database(std::move(full), vfs_name, handle));
  constexpr const char* kAttempted = "the file cannot be opened";
  if (result != SQLITE_OK) return database->failure(kAttempted, result);
  if (sqlite3_db_readonly(handle, "main") != 0) return database->failure(kAttempted, SQLITE_READONLY);
  sqlite3_busy_timeout(handle, kBusyMs);
  sqlite3_limit(handle, SQLITE_LIMIT_LENGTH, kMaxRowBytes);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  return database;
}

Expected<std::unique_ptr<Database>> Database::open_in_memory() {
  sqlite3* handle = nullptr;
  const int result = sqlite3_open(":memory:", &handle);
  std::unique_ptr<Database> database(new Database("memory", "", handle));
  if (result != SQLITE_OK) return database->failure("a database in memory cannot be made", result);
  return database;
}

Expected<void> Database::apply_settings() {
  constexpr const char* kAttempted = "the file cannot be used";
  if (Expected<void> set = run_script(kAttempted, kSettings); !set.ok()) return set;
  std::string mode;
  Expected<void> set =
      each(kAttempted, "PRAGMA journal_mode = PERSIST", [&](const Statement& row) { mode = row.text(0); });
  if (!set.ok()) return set;
  if (mode != "persist") {
    return Failure{file_.string() + ": " + kAttempted + ": its journal is '" + mode +
                   "' and does not become 'persist'"};
  }
  // From here on no other process may use the file.
  return run_script(kAttempted, "BEGIN EXCLUSIVE; COMMIT;");
}

Expected<Statement> Database::prepare(std::string_view attempted, const char* sql) {
  sqlite3_stmt* statement = nullptr;
  const int result = sqlite3_prepare_v2(handle_.get(), sql, -1, &statement, nullptr);
  if (result != SQLITE_OK) return failure(attempted, result);
  return Statement(*this, std::string(attempted), statement);
}

Expected<void> Database::run_script(std::string_view attempted, const char* sql) {
  const int result = sqlite3_exec(handle_.get(), sql, nullptr, nullptr, nullptr);
  if (result != SQLITE_OK) return failure(attempted, result);
  return {};
}

Expected<void> Database::transaction(std::string_view attempted,
                                     const std::function<Expected<void>()>& body) {
  if (Expected<void> settled = settle(attempted); !settled.ok()) return settled;
  Expected<void> done = run_script(attempted, "BEGIN IMMEDIATE");
  if (done.ok()) done = body();
  if (done.ok()) done = run_script(attempted, "COMMIT");
  if (!done.ok()) roll_back();
  return done;
}

// Whoever is told that a scan is there must rely on it, also where an earlier process or commit ended
// halfway.
Expected<void> Database::settle(std::string_view attempted) {
  if (!is_in_doubt_) return {};
  const int result = settle_journal(vfs_name_.c_str(), file_.string());
  if (result != SQLITE_OK) return failure(attempted, result);
  is_in_doubt_ = false;
  return {};
}

void Database::roll_back() {
  is_in_doubt_ = true;
  // After some errors SQLite has done so by itself. What it cannot roll back now, it does when it reads next.
  if (sqlite3_get_autocommit(handle_.get()) == 0) {
    sqlite3_exec(handle_.get(), "ROLLBACK", nullptr, nullptr, nullptr);
  }
}

std::int64_t Database::last_row() const {
  return sqlite3_last_insert_rowid(handle_.get());
}

std::int64_t Database::changed_rows() const {
  return sqlite3_changes64(handle_.get());
}

bool Database::was_full() const {
  return last_code_ == SQLITE_FULL;
}

bool Database::was_senseless() const {
  return last_code_ == SQLITE_ERROR || last_code_ == SQLITE_TOOBIG;
}

Expected<void> Database::reserve_journal() {
  const int result = traygauge::reserve_journal(vfs_name_.c_str(), file_.string());
  if (result == SQLITE_OK || result == SQLITE_FULL) return {};
  return failure("the journal cannot be made", result);
}

Failure Database::note_damage(std::string_view damage) {
  if (damage_.empty()) damage_ = damage;
  return {file_.string() + ": the file is damaged: " + damage_ + advice(SQLITE_CORRUPT)};
}

Failure Database::failure(std::string_view attempted, int result) {
  const int code = result & 0xff;
  last_code_ = code;
  const int last = handle_ == nullptr ? SQLITE_OK : sqlite3_extended_errcode(handle_.get());
  std::string text = last == result ? sqlite3_errmsg(handle_.get()) : sqlite3_errstr(result);
  if (code == SQLITE_CORRUPT || code == SQLITE_NOTADB) {
    if (damage_.empty()) damage_ = text;
  }
  const bool is_of_system = code == SQLITE_IOERR || code == SQLITE_CANTOPEN || code == SQLITE_FULL;
  const int error = handle_ == nullptr ? 0 : sqlite3_system_errno(handle_.get());
  if (is_of_system && error != 0) text += std::string(" [") + std::strerror(error) + "]";
  return {file_.string() + ": " + std::string(attempted) + ": " + text + advice(result)};
}

}  // namespace traygauge
