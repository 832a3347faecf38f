// Files as one tar.gz. libarchive is behind it, and nobody else includes that.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/base/expected.hpp"

namespace traygauge {

inline constexpr std::size_t kMaxArchiveBytes = 64UL * 1024 * 1024;  // of all files together
inline constexpr std::size_t kMaxArchiveFiles = 1000;

struct ArchivedFile {
  std::string name;  // see is_archive_name()
  std::string content;
  unsigned mode = 0644;
};

// A relative path below the folder in which it is unpacked: no "..", no empty part, no control character, at
// most 255 bytes.
bool is_archive_name(std::string_view name);

// The bytes of a tar.gz. The same files give the same bytes, but for `unix_s`, the time that each file gets.
Expected<std::string> pack_files(const std::vector<ArchivedFile>& files, std::int64_t unix_s);

// Everything or nothing: refuses an archive that is damaged anywhere, holds anything but regular files with
// names as above, one of them twice, or more than the limits.
Expected<std::vector<ArchivedFile>> unpack_files(std::string_view bytes);

}  // namespace traygauge
