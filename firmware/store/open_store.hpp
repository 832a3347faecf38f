// The hub's store: one SQLite file with every result, opened after whatever happened to it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "firmware/base/expected.hpp"
#include "firmware/base/wall_clock.hpp"
#include "firmware/store/correction_book.hpp"
#include "firmware/store/database.hpp"
#include "firmware/store/deliveries.hpp"
#include "firmware/store/file_lock.hpp"
#include "firmware/store/history.hpp"
#include "firmware/store/observed_vfs.hpp"
#include "firmware/store/retention.hpp"
#include "firmware/store/scan_store.hpp"

namespace traygauge {

// For one thread at a time.
class Store {
 public:
  Store(FileLock lock, std::unique_ptr<ObservedVfs> vfs, std::unique_ptr<Database> database,
        FreeSpace free_space);

  ScanStore& scans() { return scans_; }
  History& history() { return history_; }
  CorrectionBook& corrections() { return corrections_; }
  Deliveries& deliveries() { return deliveries_; }
  Retention& retention() { return retention_; }

  Database& database() { return *database_; }
  // Since it was opened, for the budget of bytes per scan.
  const DiskCounters& disk() const { return vfs_->counters(); }
  // Something that was read was damaged: close the store and open it anew, which looks at the whole file.
  bool is_damaged() const { return !database_->damage().empty(); }

 private:
  FileLock lock_;
  std::unique_ptr<ObservedVfs> vfs_;
  std::unique_ptr<Database> database_;
  ScanStore scans_;
  History history_;
  CorrectionBook corrections_;
  Deliveries deliveries_;
  Retention retention_;
};

struct StoreOptions {
  std::filesystem::path file;             // made where it is missing; its folder is not
  std::vector<std::string> destinations;  // see Deliveries::configure()
  // How many damaged stores stay beside this one; those beyond, the oldest, are deleted, and a notice says
  // so. None keeps all.
  std::optional<std::size_t> max_damaged_files;
  // Called every few milliseconds while the whole file is checked, which takes as long as reading it: for a
  // watchdog.
  std::function<void()> on_progress;
  FreeSpace free_space = free_bytes_of;
  DiskObserver* observer = nullptr;  // for tests
};

struct OpenedStore {
  std::unique_ptr<Store> store;
  // Sentences for the page: a damaged store was put aside, and where it is now.
  std::vector<std::string> notices;
  // Of StoreOptions::destinations, those that are told nothing of the past: see Deliveries::configure().
  std::vector<std::string> new_destinations;
};

// Holds FILE.lock while the store is open. A damaged file is put aside and an empty one takes its place.
// Fails, and leaves the file as it is, where it is another program's or of a newer version, where another
// process has it, and where the disk or its rights do not let it be used.
Expected<OpenedStore> open_store(const StoreOptions& options, const WallTime& now);

}  // namespace traygauge
