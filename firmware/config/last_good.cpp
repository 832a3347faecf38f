#include "firmware/config/last_good.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <system_error>

#include "firmware/base/file_descriptor.hpp"

namespace traygauge {
namespace {

std::string content_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// On disk when this returns true.
bool write_durably(const std::filesystem::path& file, const std::string& content) {
  const FileDescriptor written(::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600));
  if (!written.is_open()) return false;
  return write_all(written.number(), content) && ::fsync(written.number()) == 0;
}

bool sync_folder(const std::filesystem::path& folder) {
  const FileDescriptor opened(
      ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  return opened.is_open() && ::fsync(opened.number()) == 0;
}

}  // namespace

std::string keep_last_good(const std::filesystem::path& file, const std::filesystem::path& last_good) {
  const std::string content = content_of(file);
  if (content == content_of(last_good)) return {};
  std::filesystem::path written = last_good;
  written += ".new";
  // A power cut leaves the old copy or the new one.
  const bool is_kept = write_durably(written, content) && ::rename(written.c_str(), last_good.c_str()) == 0 &&
                       sync_folder(last_good.parent_path());
  if (is_kept) return {};
  std::string problem = last_good.string() + ": a copy of the configuration could not be kept there (";
  problem += std::strerror(errno);
  return problem + "); make its folder writable, or a bad configuration will stop the program";
}

}  // namespace traygauge
