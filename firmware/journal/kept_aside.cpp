#include "firmware/journal/kept_aside.hpp"

#include <algorithm>
#include <vector>

#include "firmware/journal/io_failure.hpp"

namespace traygauge {
namespace {

bool holds_bytes(File& file, std::span<const std::byte> bytes) {
  const auto size = file.size_bytes();
  if (!size.ok() || size.value != bytes.size()) return false;
  std::vector<std::byte> found(bytes.size());
  const auto read = file.read_at(0, found);
  return read.ok() && read.value == found.size() && std::equal(bytes.begin(), bytes.end(), found.begin());
}

std::error_code write_durably(FileSystem& file_system, const std::string& path,
                              std::span<const std::byte> bytes) {
  auto opened = file_system.open(path, OpenMode::existing);
  if (!opened.ok() || !holds_bytes(*opened.value, bytes)) {
    opened = file_system.open(path, OpenMode::emptied);
    if (!opened.ok()) return opened.error;
    if (const std::error_code error = opened.value->write_at(0, bytes)) return error;
  }
  if (const std::error_code error = opened.value->sync_data()) return error;
  return file_system.sync_folder_of(path);
}

}  // namespace

Expected<void> keep_aside(FileSystem& file_system, const std::string& path,
                          std::span<const std::byte> bytes) {
  if (const std::error_code error = write_durably(file_system, path, bytes)) {
    return io_failure(path, "what is damaged could not be kept in this file", error);
  }
  return {};
}

}  // namespace traygauge
