// What is damaged is kept in a file of its own, for people to look at.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "firmware/base/expected.hpp"
#include "firmware/journal/file_system.hpp"

namespace traygauge {

// Durable when it returns. A file that holds these bytes already is not written again.
Expected<void> keep_aside(FileSystem& file_system, const std::string& path, std::span<const std::byte> bytes);

}  // namespace traygauge
