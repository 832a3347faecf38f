// Events in a PostgreSQL database, which several collectors may share.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <utility>

#include "firmware/collect/collected_store.hpp"

struct pg_conn;

namespace traygauge {

class PostgresStore final : public CollectedStore {
 public:
  // Makes its tables where they are missing. Fails where the server does not answer or keeps nothing on disk
  // (fsync), and where the tables are of a newer version.
  static Expected<std::unique_ptr<CollectedStore>> open(const StoreConfig& config);

  // Connects again where the connection was lost; blocks up to half a minute.
  Expected<StoredBatch> put(std::span<const CollectedEvent> events, std::int64_t received_ms) override;
  Expected<std::int64_t> count() override;

 private:
  struct Finish {
    void operator()(pg_conn* connection) const;
  };
  using Connection = std::unique_ptr<pg_conn, Finish>;

  explicit PostgresStore(StoreConfig config) : config_(std::move(config)) {}
  Expected<void> connect();
  Expected<void> prepare();
  Expected<StoredBatch> put_all(std::span<const CollectedEvent> events, std::int64_t received_ms);
  Expected<void> put_again(std::span<const CollectedEvent> events, std::int64_t received_ms,
                           StoredBatch& batch);

  StoreConfig config_;
  Connection connection_;
};

}  // namespace traygauge
