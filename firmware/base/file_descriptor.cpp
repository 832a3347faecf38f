#include "firmware/base/file_descriptor.hpp"

#include <unistd.h>

namespace traygauge {

FileDescriptor& FileDescriptor::operator=(FileDescriptor&& other) noexcept {
  if (this != &other) {
    close();
    number_ = std::exchange(other.number_, -1);
  }
  return *this;
}

void FileDescriptor::close() {
  if (number_ >= 0) ::close(std::exchange(number_, -1));  // Linux closes it even where it reports EINTR
}

}  // namespace traygauge
