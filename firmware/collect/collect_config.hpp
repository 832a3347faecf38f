// The file that a collector is called with: config/collector.toml.
#pragma once

#include <filesystem>
#include <string>

#include "firmware/broker/broker_config.hpp"

namespace traygauge {

struct CollectConfig {
  BrokerConfig broker;
  std::string name = "collector";  // among the broker's clients
  std::filesystem::path store;     // a file
};

// Relative paths are relative to the file's folder. Throws InputError.
CollectConfig read_collect_config(const std::filesystem::path& file);

}  // namespace traygauge
