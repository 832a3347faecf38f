#include "simulator/capture/input_bytes.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string>
#include <system_error>

namespace traygauge {
namespace {

class Descriptor {
 public:
  // O_NONBLOCK: a named pipe must not hang the program.
  explicit Descriptor(const char* path) : number_(::open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  int number() const { return number_; }

 private:
  int number_;
};

std::string describe_errno(int number) {
  return std::generic_category().message(number);
}

// False where the device fails; a file that shrank gives less.
bool fill(int descriptor, std::vector<std::uint8_t>& bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t got = ::read(descriptor, bytes.data() + done, bytes.size() - done);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return false;
    if (got == 0) break;
    done += static_cast<std::size_t>(got);
  }
  bytes.resize(done);
  return true;
}

}  // namespace

std::vector<std::uint8_t> read_bytes(const InputFile& file, std::size_t max_bytes, const char* expected) {
  const auto fail = [&](const std::string& found, const std::string& hint) {
    throw InputError(file, expected, found, hint);
  };
  const Descriptor descriptor(file.path.c_str());
  if (descriptor.number() < 0) {
    fail(describe_errno(errno), "check the path and the permission to read it");
  }
  struct stat information {};
  if (::fstat(descriptor.number(), &information) != 0) {
    fail(describe_errno(errno), "check the file system");
  }
  if (!S_ISREG(information.st_mode)) fail("a folder or device", "name a file");
  const auto size = static_cast<std::size_t>(information.st_size);
  if (size > max_bytes) {
    fail(std::to_string(size) + " bytes",
         "a file of this kind has at most " + std::to_string(max_bytes) + " bytes");
  }
  std::vector<std::uint8_t> bytes(size);
  if (!fill(descriptor.number(), bytes)) fail(describe_errno(errno), "check the disk");
  return bytes;
}

std::vector<std::uint8_t> read_first_bytes(const std::filesystem::path& file, std::size_t max_bytes) {
  const Descriptor descriptor(file.c_str());
  struct stat information {};
  if (descriptor.number() < 0 || ::fstat(descriptor.number(), &information) != 0) return {};
  if (!S_ISREG(information.st_mode)) return {};
  std::vector<std::uint8_t> bytes(std::min(max_bytes, static_cast<std::size_t>(information.st_size)));
  if (!fill(descriptor.number(), bytes)) return {};
  return bytes;
}

}  // namespace traygauge
