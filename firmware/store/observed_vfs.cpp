#include "firmware/store/observed_vfs.hpp"

#include <sqlite3.h>

#include <atomic>
#include <new>
#include <string>
#include <unordered_set>
#include <utility>

namespace traygauge {

struct ObservedVfs::Parts {
  sqlite3_vfs vfs{};
  sqlite3_vfs* system = nullptr;
  std::string name;
  DiskObserver* observer = nullptr;
  DiskCounters counters;
  std::function<void()> on_reads;
  std::uint64_t reads = 0;
};

namespace {

constexpr std::int64_t kBlockBytes = 4096;
constexpr std::uint64_t kReadsPerCall = 256;

using Parts = ObservedVfs::Parts;

// SQLite reserves its memory, with room for the system's file behind it.
struct ObservedFile : sqlite3_file {
  Parts* parts = nullptr;
  const char* path = nullptr;  // null of a temporary file; SQLite keeps it until the file is closed
  std::unordered_set<std::int64_t> dirty_blocks;

  sqlite3_file* system() { return reinterpret_cast<sqlite3_file*>(this + 1); }
};

ObservedFile& observed(sqlite3_file* file) {
  return *static_cast<ObservedFile*>(file);
}

sqlite3_file* system_file(sqlite3_file* file) {
  return observed(file).system();
}

Parts& parts_of(sqlite3_vfs* vfs) {
  return *static_cast<Parts*>(vfs->pAppData);
}

int ask(const Parts& parts, const char* path, DiskOperation operation) {
  if (parts.observer == nullptr || path == nullptr) return SQLITE_OK;
  operation.path = path;
  return parts.observer->before(operation);
}

int close_file(sqlite3_file* file) {
  sqlite3_file* const system = system_file(file);
  const int result = system->pMethods->xClose(system);
  observed(file).~ObservedFile();
  return result;
}

int read_file(sqlite3_file* file, void* bytes, int count, sqlite3_int64 offset) {
  Parts& parts = *observed(file).parts;
  if (parts.on_reads && ++parts.reads % kReadsPerCall == 0) parts.on_reads();
  return system_file(file)->pMethods->xRead(system_file(file), bytes, count, offset);
}

int write_file(sqlite3_file* file, const void* bytes, int count, sqlite3_int64 offset) {
  ObservedFile& own = observed(file);
  const auto size = static_cast<std::size_t>(count);
  const int verdict = ask(*own.parts, own.path,
                          {.action = DiskAction::write,
                           .path = {},
                           .offset = offset,
                           .bytes = {static_cast<const std::byte*>(bytes), size}});
  if (verdict != SQLITE_OK) return verdict;
  const int result = own.system()->pMethods->xWrite(own.system(), bytes, count, offset);
  if (result != SQLITE_OK) return result;
  DiskCounters& counters = own.parts->counters;
  ++counters.writes;
  counters.bytes_written += size;
  for (std::int64_t block = offset / kBlockBytes; block * kBlockBytes < offset + count; ++block) {
    if (own.dirty_blocks.insert(block).second) ++counters.blocks_written;
  }
  return SQLITE_OK;
}

int truncate_file(sqlite3_file* file, sqlite3_int64 size) {
  ObservedFile& own = observed(file);
  const int verdict = ask(*own.parts, own.path, {.action = DiskAction::truncate, .path = {}, .size = size});
  return verdict != SQLITE_OK ? verdict : own.system()->pMethods->xTruncate(own.system(), size);
}

int sync_file(sqlite3_file* file, int flags) {
  ObservedFile& own = observed(file);
  const int verdict = ask(*own.parts, own.path, {.action = DiskAction::sync, .path = {}});
  if (verdict != SQLITE_OK) return verdict;
  const int result = own.system()->pMethods->xSync(own.system(), flags);
  if (result != SQLITE_OK) return result;
  own.dirty_blocks.clear();
  ++own.parts->counters.syncs;
  return SQLITE_OK;
}

int file_size(sqlite3_file* file, sqlite3_int64* size) {
  return system_file(file)->pMethods->xFileSize(system_file(file), size);
}

int lock_file(sqlite3_file* file, int level) {
  return system_file(file)->pMethods->xLock(system_file(file), level);
}

int unlock_file(sqlite3_file* file, int level) {
  return system_file(file)->pMethods->xUnlock(system_file(file), level);
}

int check_reserved_lock(sqlite3_file* file, int* is_locked) {
  return system_file(file)->pMethods->xCheckReservedLock(system_file(file), is_locked);
}

int control_file(sqlite3_file* file, int operation, void* argument) {
  return system_file(file)->pMethods->xFileControl(system_file(file), operation, argument);
}

int sector_size(sqlite3_file* file) {
  return system_file(file)->pMethods->xSectorSize(system_file(file));
}

int device_characteristics(sqlite3_file* file) {
  return system_file(file)->pMethods->xDeviceCharacteristics(system_file(file));
}

// Version 1 has no shared memory and no memory-mapped files.
const sqlite3_io_methods kMethods = {
    .iVersion = 1,
    .xClose = close_file,
    .xRead = read_file,
    .xWrite = write_file,
    .xTruncate = truncate_file,
    .xSync = sync_file,
    .xFileSize = file_size,
    .xLock = lock_file,
    .xUnlock = unlock_file,
    .xCheckReservedLock = check_reserved_lock,
    .xFileControl = control_file,
    .xSectorSize = sector_size,
    .xDeviceCharacteristics = device_characteristics,
    .xShmMap = nullptr,
    .xShmLock = nullptr,
    .xShmBarrier = nullptr,
    .xShmUnmap = nullptr,
    .xFetch = nullptr,
    .xUnfetch = nullptr,
};

int announce_creation(const Parts& parts, const char* path) {
  int exists = 0;
  const int result = parts.system->xAccess(parts.system, path, SQLITE_ACCESS_EXISTS, &exists);
  if (result != SQLITE_OK || exists != 0) return result;
  return ask(parts, path, {.action = DiskAction::create, .path = {}});
}

int open_file(sqlite3_vfs* vfs, const char* path, sqlite3_file* file, int flags, int* flags_out) {
  Parts& parts = parts_of(vfs);
  file->pMethods = nullptr;
  if (parts.observer != nullptr && path != nullptr && (flags & SQLITE_OPEN_CREATE) != 0) {
    if (const int verdict = announce_creation(parts, path); verdict != SQLITE_OK) return verdict;
  }
  auto* const own = new (file) ObservedFile;
  own->parts = &parts;
  own->path = path;
  const int result = parts.system->xOpen(parts.system, path, own->system(), flags, flags_out);
  if (result != SQLITE_OK) {
    if (own->system()->pMethods != nullptr) own->system()->pMethods->xClose(own->system());
    own->~ObservedFile();
    file->pMethods = nullptr;
    return result;
  }
  own->pMethods = &kMethods;
  return SQLITE_OK;
}

int delete_file(sqlite3_vfs* vfs, const char* path, int sync_folder) {
  Parts& parts = parts_of(vfs);
  const int verdict =
      ask(parts, path, {.action = DiskAction::remove, .path = {}, .syncs_folder = sync_folder != 0});
  return verdict != SQLITE_OK ? verdict : parts.system->xDelete(parts.system, path, sync_folder);
}

int access_file(sqlite3_vfs* vfs, const char* path, int flags, int* result) {
  sqlite3_vfs* const system = parts_of(vfs).system;
  return system->xAccess(system, path, flags, result);
}

int full_path(sqlite3_vfs* vfs, const char* path, int size, char* full) {
  sqlite3_vfs* const system = parts_of(vfs).system;
  return system->xFullPathname(system, path, size, full);
}

int randomness(sqlite3_vfs* vfs, int size, char* bytes) {
  sqlite3_vfs* const system = parts_of(vfs).system;
  return system->xRandomness(system, size, bytes);
}

int sleep_us(sqlite3_vfs* vfs, int us) {
  sqlite3_vfs* const system = parts_of(vfs).system;
  return system->xSleep(system, us);
}

int current_time(sqlite3_vfs* vfs, double* julian_day) {
  sqlite3_vfs* const system = parts_of(vfs).system;
  return system->xCurrentTime(system, julian_day);
}

int last_error(sqlite3_vfs* vfs, int size, char* text) {
  sqlite3_vfs* const system = parts_of(vfs).system;
  return system->xGetLastError(system, size, text);
}

sqlite3_vfs make_vfs(Parts& parts) {
  sqlite3_vfs vfs{};
  vfs.iVersion = 1;
  vfs.szOsFile = static_cast<int>(sizeof(ObservedFile)) + parts.system->szOsFile;
  vfs.mxPathname = parts.system->mxPathname;
  vfs.zName = parts.name.c_str();
  vfs.pAppData = &parts;
  vfs.xOpen = open_file;
  vfs.xDelete = delete_file;
  vfs.xAccess = access_file;
  vfs.xFullPathname = full_path;
  vfs.xRandomness = randomness;
  vfs.xSleep = sleep_us;
  vfs.xCurrentTime = current_time;
  vfs.xGetLastError = last_error;
  return vfs;
}

}  // namespace

ObservedVfs::ObservedVfs(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}

Expected<std::unique_ptr<ObservedVfs>> ObservedVfs::create(DiskObserver* observer) {
  static std::atomic<unsigned> count{0};
  auto parts = std::make_unique<Parts>();
  parts->system = sqlite3_vfs_find(nullptr);
  if (parts->system == nullptr) return Failure{"SQLite has no way to the disk on this system"};
  parts->name = "traygauge-" + std::to_string(++count);
  parts->observer = observer;
  parts->vfs = make_vfs(*parts);
  const int result = sqlite3_vfs_register(&parts->vfs, 0);
  if (result != SQLITE_OK) {
    return Failure{std::string("SQLite takes no further way to the disk: ") + sqlite3_errstr(result)};
  }
  return std::unique_ptr<ObservedVfs>(new ObservedVfs(std::move(parts)));
}

ObservedVfs::~ObservedVfs() {
  sqlite3_vfs_unregister(&parts_->vfs);
}

const char* ObservedVfs::name() const {
  return parts_->name.c_str();
}

const DiskCounters& ObservedVfs::counters() const {
  return parts_->counters;
}

void ObservedVfs::watch_reads(std::function<void()> on_reads) {
  parts_->on_reads = std::move(on_reads);
}

}  // namespace traygauge
