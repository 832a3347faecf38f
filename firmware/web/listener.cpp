#include "firmware/web/listener.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstddef>
#include <cstring>
#include <optional>
#include <system_error>

namespace traygauge {
namespace {

// What the kernel takes, of any family.
struct SocketAddress {
  sockaddr_storage storage{};
  socklen_t bytes = 0;

  sockaddr* pointer() {
    return reinterpret_cast<sockaddr*>(&storage);  // NOLINT(cppcoreguidelines-pro-type-reinterpret-cast)
  }
  template <class Address>
  void set(const Address& address) {
    std::memcpy(&storage, &address, sizeof(address));
    bytes = sizeof(address);
  }
};

SocketAddress socket_address(const ListenAddress& address) {
  SocketAddress result;
  if (!address.path.empty()) {
    sockaddr_un local{};
    local.sun_family = AF_UNIX;
    const std::string path = address.path.string();
    std::copy(path.begin(), path.end(), local.sun_path);
    result.set(local);
  } else if (address.address.is_ip4()) {
    sockaddr_in ip4{};
    ip4.sin_family = AF_INET;
    ip4.sin_port = htons(address.port);
    std::memcpy(&ip4.sin_addr, address.address.bytes().data() + 12, sizeof(ip4.sin_addr));
    result.set(ip4);
  } else {
    sockaddr_in6 ip6{};
    ip6.sin6_family = AF_INET6;
    ip6.sin6_port = htons(address.port);
    std::memcpy(&ip6.sin6_addr, address.address.bytes().data(), sizeof(ip6.sin6_addr));
    result.set(ip6);
  }
  return result;
}

Failure listen_failure(const ListenAddress& address, const std::string& what, int error) {
  std::string advice;
  if (error == EADDRINUSE) advice = "; another program listens there: stop it or name another port";
  if (error == EADDRNOTAVAIL) advice = "; this machine does not have that address";
  if (error == EACCES && !address.is_local()) advice = "; ports below 1024 are for root: name another port";
  return {address.text() + ": " + what + ": " + std::system_category().message(error) + advice};
}

// Removes a socket file on which nobody listens any more.
Expected<void> make_room(const ListenAddress& address) {
  struct stat found {};
  if (::lstat(address.path.c_str(), &found) != 0) return {};
  if (!S_ISSOCK(found.st_mode))
    return Failure{address.text() + ": expected a socket or nothing, found a file; name another path"};
  const FileDescriptor probe(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  SocketAddress local = socket_address(address);
  const bool is_alive = ::connect(probe.number(), local.pointer(), local.bytes) == 0 || errno != ECONNREFUSED;
  if (is_alive) return Failure{address.text() + ": another program listens there; stop it first"};
  ::unlink(address.path.c_str());
  return {};
}

// Zero, or the error.
int bind_and_listen(int descriptor, const ListenAddress& address) {
  constexpr int kYes = 1;
  constexpr int kNo = 0;
  SocketAddress local = socket_address(address);
  if (address.path.empty()) {
    ::setsockopt(descriptor, SOL_SOCKET, SO_REUSEADDR, &kYes, sizeof(kYes));
    // "*" means IPv4, too.
    if (local.storage.ss_family == AF_INET6)
      ::setsockopt(descriptor, IPPROTO_IPV6, IPV6_V6ONLY, &kNo, sizeof(kNo));
  }
  if (::bind(descriptor, local.pointer(), local.bytes) != 0) return errno;
  if (!address.path.empty() && ::chmod(address.path.c_str(), S_IRUSR | S_IWUSR | S_IRGRP | S_IWGRP) != 0)
    return errno;
  return ::listen(descriptor, SOMAXCONN) != 0 ? errno : 0;
}

std::uint16_t bound_port(int descriptor) {
  SocketAddress bound;
  bound.bytes = sizeof(bound.storage);
  ::getsockname(descriptor, bound.pointer(), &bound.bytes);
  // The port stands at the same place in both families.
  sockaddr_in address{};
  std::memcpy(&address, &bound.storage, sizeof(address));
  return ntohs(address.sin_port);
}

}  // namespace

std::string ListenAddress::text() const {
  if (!path.empty()) return path.string();
  const std::string host = address.is_ip4() ? address.text() : "[" + address.text() + "]";
  return host + ":" + std::to_string(port);
}

Expected<ListenAddress> parse_listen_address(std::string_view text) {
  const Failure failure{
      std::string(text) +
      ": expected ADDRESS:PORT, such as 127.0.0.1:8080, [::1]:8080 or *:8080, or the absolute "
      "path of a Unix socket"};
  ListenAddress result;
  if (!text.empty() && text.front() == '/') {
    if (text.size() >= sizeof(sockaddr_un::sun_path))
      return Failure{std::string(text) + ": expected a path of at most " +
                     std::to_string(sizeof(sockaddr_un::sun_path) - 1) + " bytes for a socket"};
    result.path = text;
    return result;
  }
  const std::size_t colon = text.rfind(':');
  if (colon == std::string_view::npos) return failure;
  std::string_view host = text.substr(0, colon);
  const std::string_view port = text.substr(colon + 1);
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), result.port);
  if (error != std::errc() || end != port.data() + port.size()) return failure;
  const bool in_brackets = host.size() > 2 && host.front() == '[' && host.back() == ']';
  if (in_brackets) host = host.substr(1, host.size() - 2);
  if (host == "*")
    host = "::";
  else if (host == "localhost")
    host = "127.0.0.1";
  else if (!in_brackets && host.find(':') != std::string_view::npos)
    return failure;
  const std::optional<PeerAddress> address = PeerAddress::parse(host);
  if (!address) return failure;
  result.address = *address;
  return result;
}

Expected<Listener> Listener::open(const ListenAddress& address) {
  if (!address.path.empty()) {
    const Expected<void> room = make_room(address);
    if (!room.ok()) return Failure{room.failure()};
  }
  const auto family = socket_address(address).storage.ss_family;
  FileDescriptor socket(::socket(family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (!socket.is_open()) return listen_failure(address, "no socket can be opened", errno);
  if (const int error = bind_and_listen(socket.number(), address); error != 0)
    return listen_failure(address, "cannot be listened to", error);
  ListenAddress taken = address;
  if (taken.path.empty()) taken.port = bound_port(socket.number());
  return Listener(std::move(socket), std::move(taken));
}

Listener::~Listener() {
  if (!socket_.is_open()) return;
  socket_.close();
  if (!address_.path.empty()) ::unlink(address_.path.c_str());
}

}  // namespace traygauge
