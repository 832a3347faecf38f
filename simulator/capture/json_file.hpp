// JSON documents from files, with limits on size and nesting.
#pragma once

#include <filesystem>

#include "simulator/capture/json_node.hpp"

namespace traygauge {

// Throws InputError: absent, unreadable, above 1 MiB, not JSON, nested deeper than 32.
JsonDocument read_json(const std::filesystem::path& file);

}  // namespace traygauge
