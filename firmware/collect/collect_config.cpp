#include "firmware/collect/collect_config.hpp"

#include <array>

#include "firmware/base/scan_id.hpp"
#include "simulator/capture/toml_file.hpp"

namespace traygauge {
namespace {

StoreConfig read_store(const JsonNode& root, const std::filesystem::path& folder) {
  StoreConfig config;
  const std::string store = root.member("store").text();
  const auto password = root.find("store_password_file");
  if (!store.starts_with("postgresql://") && !store.starts_with("postgres://")) {
    if (password) password->fail("no password beside a file of SQLite", "remove it");
    config.file = folder / store;
    return config;
  }
  config.database = store;
  if (password) config.password = folder / password->text();
  return config;
}

}  // namespace

CollectConfig read_collect_config(const std::filesystem::path& file) {
  constexpr std::size_t kMaxBytes = std::size_t{1} << 16U;
  constexpr int kVersion = 1;
  const JsonDocument document = read_toml(file, kMaxBytes, "a collector in TOML");
  const JsonNode root = document.root();
  check_file_version(root, kVersion, "collector's file");
  expect_keys(root,
              std::to_array<std::string_view>({"version", "name", "store", "store_password_file", "broker"}));
  const JsonNode broker = root.member("broker");
  expect_keys(broker, broker_keys());
  CollectConfig config;
  config.broker = read_broker_keys(broker, "broker", file.parent_path());
  config.store = read_store(root, file.parent_path());
  if (const auto name = root.find("name")) {
    config.name = name->text();
    // Of the form of a station's.
    if (!is_station_name(config.name))
      name->fail("1 to 32 of a-z, 0-9 and '-', with no '-' at either end", "correct the value");
  }
  return config;
}

}  // namespace traygauge
