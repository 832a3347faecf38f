// Events in one SQLite file, which one collector has to itself.
#pragma once

#include <filesystem>
#include <memory>
#include <span>

#include "firmware/collect/collected_store.hpp"
#include "firmware/store/database.hpp"

namespace traygauge {

class SqliteStore final : public CollectedStore {
 public:
  // Made where it is missing; its folder is not. Holds the file for this process alone. Fails where it is
  // another program's, or of a newer version.
  static Expected<std::unique_ptr<CollectedStore>> open(const std::filesystem::path& file);

  Expected<StoredBatch> put(std::span<const CollectedEvent> events, std::int64_t received_ms) override;
  Expected<std::int64_t> count() override;

 private:
  explicit SqliteStore(std::unique_ptr<Database> database) : database_(std::move(database)) {}
  Expected<void> prepare_tables();
  Expected<void> put_one(const CollectedEvent& event, std::int64_t received_ms, StoredBatch& batch);

  std::unique_ptr<Database> database_;
};

}  // namespace traygauge
