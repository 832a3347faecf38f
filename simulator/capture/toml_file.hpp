// TOML documents from files, as JSON, so that their values are read and checked by one reader.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

#include "simulator/capture/json_node.hpp"

namespace traygauge {

// `expected` names the content in errors: "a dish in TOML". Dates become null: no key of ours takes one.
// Throws InputError: absent, unreadable, larger than `max_bytes`, not TOML.
JsonDocument read_toml(const std::filesystem::path& file, std::size_t max_bytes, const char* expected);

// The key `version` of a file that people edit. Without it the file is of version 1. Throws InputError unless
// it is from 1 to `newest`; `what` names such a file: "station file". Read it before other keys, which a
// later version may have.
void check_file_version(const JsonNode& root, int newest, const char* what);

// Throws InputError for a key of this table that is none of `keys`: it is a typing mistake.
void expect_keys(const JsonNode& table, std::span<const std::string_view> keys);

}  // namespace traygauge
