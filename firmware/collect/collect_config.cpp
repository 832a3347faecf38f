#include "firmware/collect/collect_config.hpp"

#include <array>

#include "firmware/base/scan_id.hpp"
#include "simulator/capture/toml_file.hpp"

namespace traygauge {

CollectConfig read_collect_config(const std::filesystem::path& file) {
  constexpr std::size_t kMaxBytes = std::size_t{1} << 16U;
  constexpr int kVersion = 1;
  const JsonDocument document = read_toml(file, kMaxBytes, "a collector in TOML");
  const JsonNode root = document.root();
  check_file_version(root, kVersion, "collector's file");
  expect_keys(root, std::to_array<std::string_view>({"version", "name", "store", "broker"}));
  const JsonNode broker = root.member("broker");
  expect_keys(broker, broker_keys());
  CollectConfig config;
  config.broker = read_broker_keys(broker, "broker", file.parent_path());
  config.store = file.parent_path() / root.member("store").text();
  if (const auto name = root.find("name")) {
    config.name = name->text();
    // Of the form of a station's.
    if (!is_station_name(config.name))
      name->fail("1 to 32 of a-z, 0-9 and '-', with no '-' at either end", "correct the value");
  }
  return config;
}

}  // namespace traygauge
