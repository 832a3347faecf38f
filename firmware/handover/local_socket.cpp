#include "firmware/handover/local_socket.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <system_error>

namespace traygauge {
namespace {

using SteadyClock = std::chrono::steady_clock;

std::string error_text(int error) {
  return std::system_category().message(error);
}

Failure failure(const std::filesystem::path& path, const std::string& what, int error) {
  return {path.string() + ": " + what + ": " + error_text(error)};
}

Expected<sockaddr_un> address_of(const std::filesystem::path& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string text = path.string();
  if (text.empty() || text.size() >= sizeof(address.sun_path))
    return Failure{path.string() + ": expected a path of 1 to " +
                   std::to_string(sizeof(address.sun_path) - 1) + " bytes for a socket, found " +
                   std::to_string(text.size())};
  std::copy(text.begin(), text.end(), address.sun_path);
  return address;
}

int connect_to(int socket, const sockaddr_un& address) {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): the kernel's interface
  return ::connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof(address));
}

FileDescriptor open_socket() {
  return FileDescriptor(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
}

// False when `timeout` passed first.
bool wait_for(int descriptor, std::int16_t events, Milliseconds timeout) {
  pollfd waiting{descriptor, events, 0};
  const auto end = SteadyClock::now() + timeout;
  for (;;) {
    const auto left = std::chrono::ceil<Milliseconds>(end - SteadyClock::now());
    const int ready = ::poll(&waiting, 1, static_cast<int>(std::max<Milliseconds::rep>(left.count(), 0)));
    if (ready > 0) return true;
    if (ready == 0 || errno != EINTR) return false;
  }
}

}  // namespace

Expected<std::size_t> LocalConnection::send_some(std::string_view bytes) const {
  for (;;) {
    const ssize_t sent = ::send(descriptor(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent >= 0) return static_cast<std::size_t>(sent);
    if (errno == EAGAIN || errno == EWOULDBLOCK) return std::size_t{0};
    if (errno != EINTR) return Failure{"the other end of the socket is gone: " + error_text(errno)};
  }
}

Expected<void> LocalConnection::send_all(std::string_view bytes, Milliseconds timeout) const {
  const auto end = SteadyClock::now() + timeout;
  for (;;) {
    const Expected<std::size_t> sent = send_some(bytes);
    if (!sent.ok()) return Failure{sent.failure()};
    bytes.remove_prefix(*sent);
    if (bytes.empty()) return {};
    const auto left = std::chrono::ceil<Milliseconds>(end - SteadyClock::now());
    if (left <= Milliseconds::zero() || !wait_for(descriptor(), POLLOUT, left))
      return Failure{"the other end of the socket does not read"};
  }
}

Expected<std::string> LocalConnection::receive_some(Milliseconds timeout) const {
  constexpr std::size_t kMaxAtOnce = 65536;
  if (!wait_for(descriptor(), POLLIN, timeout)) return std::string();
  std::string bytes(kMaxAtOnce, '\0');
  for (;;) {
    const ssize_t received = ::recv(descriptor(), bytes.data(), bytes.size(), 0);
    if (received > 0) {
      bytes.resize(static_cast<std::size_t>(received));
      return bytes;
    }
    if (received == 0) return Failure{"the other end of the socket was closed"};
    if (errno == EAGAIN || errno == EWOULDBLOCK) return std::string();
    if (errno != EINTR) return Failure{"the other end of the socket is gone: " + error_text(errno)};
  }
}

Expected<LocalConnection> connect_local(const std::filesystem::path& path) {
  const Expected<sockaddr_un> address = address_of(path);
  if (!address.ok()) return Failure{address.failure()};
  FileDescriptor socket = open_socket();
  if (!socket.is_open()) return failure(path, "no socket can be opened", errno);
  // A local socket connects at once or not at all: EAGAIN is a queue that is full.
  if (connect_to(socket.number(), *address) != 0) return failure(path, "nobody answers there", errno);
  return LocalConnection(std::move(socket));
}

Expected<LocalListener> LocalListener::open(const std::filesystem::path& path) {
  const Expected<sockaddr_un> address = address_of(path);
  if (!address.ok()) return Failure{address.failure()};
  // Whoever holds the lock owns the path, so that of two programs that start at once one wins.
  const std::filesystem::path lock_path = path.string() + ".lock";
  FileDescriptor lock(::open(lock_path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600));
  if (!lock.is_open()) return failure(lock_path, "cannot be opened", errno);
  if (::flock(lock.number(), LOCK_EX | LOCK_NB) != 0)
    return Failure{path.string() + ": another hub listens there; stop it first"};
  struct stat found {};
  if (::lstat(path.c_str(), &found) == 0) {
    if (!S_ISSOCK(found.st_mode))
      return Failure{path.string() + ": expected a socket or nothing, found a file; name another path"};
    ::unlink(path.c_str());
  }
  FileDescriptor socket = open_socket();
  if (!socket.is_open()) return failure(path, "no socket can be opened", errno);
  constexpr int kQueue = 16;
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): the kernel's interface
  const auto* const bound_to = reinterpret_cast<const sockaddr*>(&*address);
  if (::bind(socket.number(), bound_to, sizeof(*address)) != 0)
    return failure(path, "the socket cannot be made there", errno);
  if (::chmod(path.c_str(), S_IRUSR | S_IWUSR | S_IRGRP | S_IWGRP) != 0)
    return failure(path, "its permissions cannot be set", errno);
  if (::listen(socket.number(), kQueue) != 0) return failure(path, "nobody can be listened to", errno);
  return LocalListener(std::move(lock), std::move(socket), path);
}

LocalListener::~LocalListener() {
  if (socket_.is_open()) ::unlink(path_.c_str());
}

Expected<LocalConnection> LocalListener::accept() {
  for (;;) {
    FileDescriptor socket(::accept4(descriptor(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
    if (socket.is_open()) return LocalConnection(std::move(socket));
    if (errno == EAGAIN || errno == EWOULDBLOCK || errno == ECONNABORTED) return LocalConnection();
    if (errno != EINTR) return failure(path_, "a connection cannot be taken", errno);
  }
}

}  // namespace traygauge
