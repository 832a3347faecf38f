#include "firmware/store/persistent_journal.hpp"

#include <sqlite3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>

namespace traygauge {
namespace {

constexpr std::size_t kHeaderBytes = 28;
// To delete a scan takes some 15 pages.
constexpr sqlite3_int64 kReservedBytes = 65'536;

struct FreeFilename {
  void operator()(const char* name) const { sqlite3_free_filename(const_cast<char*>(name)); }
};

int rewrite_zeroes(sqlite3_file& file) {
  std::array<char, kHeaderBytes> header{};
  const int size = static_cast<int>(header.size());
  const int read = file.pMethods->xRead(&file, header.data(), size, 0);
  if (read == SQLITE_IOERR_SHORT_READ) return SQLITE_OK;  // shorter than any journal
  if (read != SQLITE_OK) return read;
  if (std::any_of(header.begin(), header.end(), [](char byte) { return byte != 0; })) return SQLITE_OK;
  const int written = file.pMethods->xWrite(&file, header.data(), size, 0);
  return written != SQLITE_OK ? written : file.pMethods->xSync(&file, SQLITE_SYNC_NORMAL);
}

int append_zeroes(sqlite3_file& file) {
  constexpr std::array<char, 4096> kZeroes{};
  sqlite3_int64 size = 0;
  int result = file.pMethods->xFileSize(&file, &size);
  if (result != SQLITE_OK || size >= kReservedBytes) return result;
  while (result == SQLITE_OK && size < kReservedBytes) {
    const sqlite3_int64 piece = std::min(kReservedBytes - size, static_cast<sqlite3_int64>(kZeroes.size()));
    result = file.pMethods->xWrite(&file, kZeroes.data(), static_cast<int>(piece), size);
    size += piece;
  }
  return result != SQLITE_OK ? result : file.pMethods->xSync(&file, SQLITE_SYNC_NORMAL);
}

// SQLITE_OK, and nothing done, where there is no journal.
int with_journal(const char* vfs_name, const std::string& database_file, int (*work)(sqlite3_file&)) {
  sqlite3_vfs* const vfs = sqlite3_vfs_find(vfs_name);
  if (vfs == nullptr) return SQLITE_ERROR;
  const std::string journal = database_file + "-journal";
  int exists = 0;
  const int looked = vfs->xAccess(vfs, journal.c_str(), SQLITE_ACCESS_EXISTS, &exists);
  if (looked != SQLITE_OK || exists == 0) return looked;
  const std::unique_ptr<const char, FreeFilename> name(
      sqlite3_create_filename(database_file.c_str(), journal.c_str(), "", 0, nullptr));
  if (name == nullptr) return SQLITE_NOMEM;
  const auto memory = std::make_unique<std::max_align_t[]>(
      static_cast<std::size_t>(vfs->szOsFile) / sizeof(std::max_align_t) + 1);
  auto* const file = reinterpret_cast<sqlite3_file*>(memory.get());
  int flags = SQLITE_OPEN_READWRITE | SQLITE_OPEN_MAIN_JOURNAL;
  const int opened = vfs->xOpen(vfs, sqlite3_filename_journal(name.get()), file, flags, &flags);
  if (opened != SQLITE_OK) return opened;
  const int done = (flags & SQLITE_OPEN_READONLY) != 0 ? SQLITE_READONLY : work(*file);
  const int closed = file->pMethods->xClose(file);
  return done != SQLITE_OK ? done : closed;
}

}  // namespace

int settle_journal(const char* vfs_name, const std::string& database_file) {
  return with_journal(vfs_name, database_file, rewrite_zeroes);
}

int reserve_journal(const char* vfs_name, const std::string& database_file) {
  return with_journal(vfs_name, database_file, append_zeroes);
}

}  // namespace traygauge
