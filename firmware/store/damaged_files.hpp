// Stores that could not be read are kept: most of their scans can be saved by hand.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "firmware/base/expected.hpp"

namespace traygauge {

// Renames the file, and what SQLite keeps beside it, to "NAME.damaged-20261127T074012Z"; gives the new name.
// On return the renaming is on disk.
Expected<std::filesystem::path> move_aside(const std::filesystem::path& file, std::int64_t now_ms);

// Those of this file, by name: the oldest first where the clock was right.
Expected<std::vector<std::filesystem::path>> list_damaged_files(const std::filesystem::path& file);

// Deletes the first of them so that `max` remain; gives what it deleted.
Expected<std::vector<std::filesystem::path>> limit_damaged_files(const std::filesystem::path& file,
                                                                 std::size_t max);

}  // namespace traygauge
