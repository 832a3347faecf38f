// How a program reaches an MQTT broker, as a table of TOML says it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "simulator/capture/json_node.hpp"

namespace traygauge {

struct BrokerConfig {
  std::string table;  // where it stands, for sentences: "fleet" where the keys are fleet.host and so on
  std::string host;   // a name or a literal address
  std::uint16_t port = 8883;
  bool is_encrypted = true;
  std::optional<std::filesystem::path> trusted;      // a file with certificates; none: the system's
  std::optional<std::filesystem::path> certificate;  // this program's own
  std::optional<std::filesystem::path> certificate_key;
  std::string user;  // empty: none
  std::optional<std::filesystem::path> password_file;
  std::string prefix = "traygauge";  // of topics

  // What logs and pages call it: "mqtts://broker.example:8883".
  std::string shown() const;
};

// The keys that read_broker_keys() reads, for expect_keys().
const std::vector<std::string_view>& broker_keys();

// Relative paths are relative to `folder`. Throws InputError. `name` is the table's.
BrokerConfig read_broker_keys(const JsonNode& table, const std::string& name,
                              const std::filesystem::path& folder);

}  // namespace traygauge
