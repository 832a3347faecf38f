// Files that are on disk, whole, before a command says that they are.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "firmware/base/expected.hpp"

namespace traygauge {

struct FileToWrite {
  std::filesystem::path path;
  std::string content;
  unsigned mode = 0644;
};

enum class IfThere { refuse, replace };

// All files are written under temporary names and synced before the first one gets its own name, in the order
// given. Folders are made where they are missing. Where one cannot be written, for want of space or rights,
// none gets its name.
Expected<void> write_files(const std::vector<FileToWrite>& files, IfThere if_there);

// Whether an archive may be written there: in a folder that is there, in place of an older archive or of
// nothing.
Expected<void> check_archive_place(const std::filesystem::path& file);

// All of a regular file of at most `max_bytes`.
Expected<std::string> read_file(const std::filesystem::path& file, std::size_t max_bytes);

}  // namespace traygauge
