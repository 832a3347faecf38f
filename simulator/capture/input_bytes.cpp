#include "simulator/capture/input_bytes.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

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
  std::size_t done = 0;
  while (done < size) {
    const ssize_t got = ::read(descriptor.number(), bytes.data() + done, size - done);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail(describe_errno(errno), "check the disk");
    if (got == 0) break;  // the file shrank meanwhile; its decoder will tell
    done += static_cast<std::size_t>(got);
  }
  bytes.resize(done);
  return bytes;
}

}  // namespace traygauge
