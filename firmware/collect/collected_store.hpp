// Events of many hubs in one SQLite file, each once.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "firmware/base/expected.hpp"
#include "firmware/collect/collected_event.hpp"
#include "firmware/store/database.hpp"

namespace traygauge {

struct StoredBatch {
  std::size_t stored = 0;          // for the first time
  std::size_t repeated = 0;        // had come before
  std::vector<std::string> twins;  // ids that another tray has, too; both are kept, the later ones in `twins`
};

class CollectedStore {
 public:
  // Made where it is missing; its folder is not. Holds the file for this process alone. Fails where it is
  // another program's, or of a newer version.
  static Expected<CollectedStore> open(const std::filesystem::path& file);

  // All of it is on disk when this returns ok, else nothing of it. `received_ms`: UTC.
  Expected<StoredBatch> put(std::span<const CollectedEvent> events, std::int64_t received_ms);
  Expected<std::int64_t> count();

 private:
  explicit CollectedStore(std::unique_ptr<Database> database) : database_(std::move(database)) {}
  Expected<void> prepare_tables();
  Expected<void> put_one(const CollectedEvent& event, std::int64_t received_ms, StoredBatch& batch);

  std::unique_ptr<Database> database_;
};

}  // namespace traygauge
