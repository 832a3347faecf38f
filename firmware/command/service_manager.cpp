#include "firmware/command/service_manager.hpp"

#include <sys/socket.h>
#include <sys/un.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>

namespace traygauge {

ServiceManager::ServiceManager() {
  // NOLINTNEXTLINE(concurrency-mt-unsafe): read at the start, before any thread
  const char* const path = std::getenv("NOTIFY_SOCKET");
  if (path == nullptr || (path[0] != '/' && path[0] != '@')) return;
  path_ = path;
  // The seccomp filter of a program allows no new socket once it runs.
  socket_ = FileDescriptor(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
}

void ServiceManager::note_progress() {
  send(is_ready_ ? "WATCHDOG=1" : "READY=1\nWATCHDOG=1");
  is_ready_ = true;
}

void ServiceManager::note_stopping() {
  send("STOPPING=1");
}

void ServiceManager::send(const char* text) const {
  sockaddr_un address{};
  if (!socket_.is_open() || path_.size() >= sizeof(address.sun_path)) return;
  address.sun_family = AF_UNIX;
  std::memcpy(address.sun_path, path_.data(), path_.size());
  // A name in no folder begins with a zero, and ends without one.
  const bool is_abstract = path_.front() == '@';
  if (is_abstract) address.sun_path[0] = '\0';
  const std::size_t bytes = offsetof(sockaddr_un, sun_path) + path_.size() + (is_abstract ? 0 : 1);
  ::sendto(socket_.number(), text, std::strlen(text), MSG_NOSIGNAL,
           reinterpret_cast<const sockaddr*>(&address), static_cast<socklen_t>(bytes));
}

}  // namespace traygauge
