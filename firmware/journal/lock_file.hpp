// One process a file.
#pragma once

#include <memory>
#include <string>

#include "firmware/base/expected.hpp"
#include "firmware/journal/file_system.hpp"

namespace traygauge {

// Held as long as the object lives, by a file of its own (PATH.lock), because the other one may be replaced.
Expected<std::unique_ptr<File>> lock_file(FileSystem& file_system, const std::string& path);

}  // namespace traygauge
