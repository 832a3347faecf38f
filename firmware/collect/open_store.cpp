#include "firmware/collect/collected_store.hpp"
#include "firmware/collect/postgres_store.hpp"
#include "firmware/collect/sqlite_store.hpp"

namespace traygauge {

Expected<std::unique_ptr<CollectedStore>> open_collected_store(const StoreConfig& config) {
  if (config.database.empty()) return SqliteStore::open(config.file);
  return PostgresStore::open(config);
}

}  // namespace traygauge
