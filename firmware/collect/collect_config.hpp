// The file that a collector is called with: config/collector.toml.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "firmware/broker/broker_config.hpp"

namespace traygauge {

// One of the two.
struct StoreConfig {
  std::filesystem::path file;                     // of SQLite
  std::string database;                           // postgresql://…, without a password
  std::optional<std::filesystem::path> password;  // a file with that of the database

  // What logs call it.
  std::string shown() const { return database.empty() ? file.string() : database; }
};

struct CollectConfig {
  BrokerConfig broker;
  std::string name = "collector";  // among the broker's clients
  StoreConfig store;
};

// Relative paths are relative to the file's folder. Throws InputError.
CollectConfig read_collect_config(const std::filesystem::path& file);

}  // namespace traygauge
