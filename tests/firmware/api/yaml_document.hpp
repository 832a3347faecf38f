// A YAML file as JSON.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace traygauge::test {

// Throws where the file cannot be read, is no YAML, or names a key twice.
nlohmann::json read_yaml(const std::filesystem::path& file);

}  // namespace traygauge::test
