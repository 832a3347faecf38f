#include "firmware/base/secret_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "firmware/base/file_descriptor.hpp"

namespace traygauge {
namespace {

constexpr std::size_t kMaxSecretBytes = 64UL * 1024;

std::string too_long(const std::string& path, const std::string& what) {
  return path + ": expected at most " + std::to_string(kMaxSecretBytes) + " bytes of " + what;
}

// Of the open file, so that it cannot be exchanged between the check and the reading.
std::string refusal_of(const struct stat& found, const std::string& path, const std::string& what) {
  if (!S_ISREG(found.st_mode)) return path + ": expected a file with " + what + ", found something else";
  if ((found.st_mode & (S_IRWXG | S_IRWXO)) != 0)
    return path + ": others can read or change " + what + " there: chmod 600 " + path;
  if (found.st_uid != ::geteuid() && found.st_uid != 0)
    return path + ": expected a file of this program's user or root: chown it, or name another file";
  if (static_cast<std::size_t>(found.st_size) > kMaxSecretBytes) return too_long(path, what);
  return {};
}

}  // namespace

Expected<std::string> read_secret_file(const std::string& path, const std::string& what) {
  // A pipe must not stop the hub.
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (!file.is_open()) return Failure{path + ": cannot be read: " + std::system_category().message(errno)};
  struct stat found {};
  if (::fstat(file.number(), &found) != 0) return Failure{path + ": cannot be looked at"};
  if (const std::string refusal = refusal_of(found, path, what); !refusal.empty()) return Failure{refusal};
  std::string text(kMaxSecretBytes + 1, '\0');
  std::size_t bytes = 0;
  while (bytes < text.size()) {
    const ssize_t got = ::read(file.number(), text.data() + bytes, text.size() - bytes);
    if (got == 0) break;
    if (got > 0) bytes += static_cast<std::size_t>(got);
    if (got < 0 && errno != EINTR)
      return Failure{path + ": cannot be read: " + std::system_category().message(errno)};
  }
  if (bytes > kMaxSecretBytes) return Failure{too_long(path, what)};
  text.resize(bytes);
  return text;
}

Expected<std::string> read_password_file(const std::string& path, const std::string& key) {
  constexpr std::size_t kMaxCharacters = 256;
  Expected<std::string> password = read_secret_file(path, "a password");
  if (!password.ok()) return Failure{key + ": " + password.failure()};
  while (password->ends_with('\n') || password->ends_with('\r')) password->pop_back();
  const bool is_line = password->find_first_of(std::string("\n\0", 2)) == std::string::npos;
  if (is_line && !password->empty() && password->size() <= kMaxCharacters) return password;
  return Failure{key + ": " + path + ": expected one line of 1 to 256 characters, found " +
                 (is_line ? std::to_string(password->size()) : "several")};
}

}  // namespace traygauge
