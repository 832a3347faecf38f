#include "firmware/journal/posix_file_system.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>

#include "firmware/base/file_descriptor.hpp"

namespace traygauge {
namespace {

std::error_code code_of(int error_number) {
  return {error_number, std::generic_category()};
}

// Calls until no signal interrupts; -1 sets errno.
template <class Call>
auto uninterrupted(Call call) {
  for (;;) {
    const auto result = call();
    if (result != -1 || errno != EINTR) return result;
  }
}

std::error_code code_of_call(int result) {
  return result == 0 ? std::error_code() : code_of(errno);
}

class PosixFile : public File {
 public:
  explicit PosixFile(int descriptor) : descriptor_(descriptor) {}

  IoResult<std::size_t> read_at(std::uint64_t offset_bytes, std::span<std::byte> into) override {
    std::size_t done = 0;
    while (done < into.size()) {
      const ssize_t count = uninterrupted([&] {
        return ::pread(descriptor_.number(), into.data() + done, into.size() - done,
                       static_cast<off_t>(offset_bytes + done));
      });
      if (count < 0) return {done, code_of(errno)};
      if (count == 0) break;
      done += static_cast<std::size_t>(count);
    }
    return {done, {}};
  }

  std::error_code write_at(std::uint64_t offset_bytes, std::span<const std::byte> bytes) override {
    std::size_t done = 0;
    while (done < bytes.size()) {
      const ssize_t count = uninterrupted([&] {
        return ::pwrite(descriptor_.number(), bytes.data() + done, bytes.size() - done,
                        static_cast<off_t>(offset_bytes + done));
      });
      if (count < 0) return code_of(errno);
      if (count == 0) return code_of(EIO);
      done += static_cast<std::size_t>(count);
    }
    return {};
  }

  IoResult<std::uint64_t> size_bytes() override {
    struct stat status {};
    if (::fstat(descriptor_.number(), &status) != 0) return {0, code_of(errno)};
    return {static_cast<std::uint64_t>(status.st_size), {}};
  }

  std::error_code reserve(std::uint64_t bytes) override {
    for (;;) {  // it returns its error and leaves errno alone
      const int error = ::posix_fallocate(descriptor_.number(), 0, static_cast<off_t>(bytes));
      if (error != EINTR) return error == 0 ? std::error_code() : code_of(error);
    }
  }

  std::error_code sync_data() override {
    return code_of_call(uninterrupted([&] { return ::fdatasync(descriptor_.number()); }));
  }

  std::error_code try_lock() override {
    return code_of_call(uninterrupted([&] { return ::flock(descriptor_.number(), LOCK_EX | LOCK_NB); }));
  }

 private:
  FileDescriptor descriptor_;
};

int open_flags(OpenMode mode) {
  switch (mode) {
    case OpenMode::existing:
      return 0;
    case OpenMode::existing_or_new:
      return O_CREAT;
    case OpenMode::emptied:
      return O_CREAT | O_TRUNC;
  }
  return 0;
}

class PosixFileSystem : public FileSystem {
 public:
  IoResult<std::unique_ptr<File>> open(const std::string& path, OpenMode mode) override {
    const int descriptor = uninterrupted([&] {
      return ::open(path.c_str(), O_RDWR | O_CLOEXEC | O_NOCTTY | open_flags(mode), S_IRUSR | S_IWUSR);
    });
    if (descriptor < 0) return {nullptr, code_of(errno)};
    return {std::make_unique<PosixFile>(descriptor), {}};
  }

  std::error_code rename(const std::string& from, const std::string& to) override {
    return code_of_call(std::rename(from.c_str(), to.c_str()));
  }

  std::error_code remove(const std::string& path) override { return code_of_call(::unlink(path.c_str())); }

  std::error_code sync_folder_of(const std::string& path) override {
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    const FileDescriptor descriptor(uninterrupted(
        [&] { return ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); }));
    if (descriptor.number() < 0) return code_of(errno);
    return code_of_call(uninterrupted([&] { return ::fsync(descriptor.number()); }));
  }

  IoResult<std::uint64_t> unique_number() override {
    std::uint64_t number = 0;
    const ssize_t count = uninterrupted([&] { return ::getrandom(&number, sizeof number, 0); });
    if (count != static_cast<ssize_t>(sizeof number)) return {0, code_of(count < 0 ? errno : EIO)};
    return {number, {}};
  }
};

}  // namespace

FileSystem& posix_file_system() {
  static PosixFileSystem file_system;
  return file_system;
}

}  // namespace traygauge
