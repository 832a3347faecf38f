#include "simulator/devices/capture_folders.hpp"

#include <algorithm>
#include <system_error>

namespace traygauge {
namespace {

bool is_capture(const std::filesystem::path& folder) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(folder / "capture.json", ignored);
}

}  // namespace

std::vector<std::filesystem::path> find_capture_folders(const std::filesystem::path& folder) {
  if (is_capture(folder)) return {folder};
  std::vector<std::filesystem::path> captures;
  std::error_code error;
  std::filesystem::directory_iterator entry(folder, error);
  for (; !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
    if (is_capture(entry->path())) captures.push_back(entry->path());
  }
  std::sort(captures.begin(), captures.end());
  return captures;
}

}  // namespace traygauge
