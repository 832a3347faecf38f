#include "firmware/support/hub_health.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <optional>
#include <string_view>
#include <system_error>

#include "firmware/base/file_descriptor.hpp"

namespace traygauge {
namespace {

using SteadyClock = std::chrono::steady_clock;

struct SocketAddress {
  sockaddr_storage storage{};
  socklen_t bytes = 0;
};

SocketAddress unix_address(const std::string& path) {
  SocketAddress address;
  auto& unix_socket = reinterpret_cast<sockaddr_un&>(address.storage);
  unix_socket.sun_family = AF_UNIX;
  path.copy(unix_socket.sun_path, sizeof unix_socket.sun_path - 1);
  address.bytes = sizeof unix_socket;
  return address;
}

// Of "127.0.0.1:8080", "[::1]:8080", "localhost:8080", "*:8080" or a path; none for addresses of other
// networks.
std::optional<SocketAddress> local_address(const std::string& listen) {
  if (listen.starts_with('/')) return unix_address(listen);
  const std::size_t colon = listen.rfind(':');
  if (colon == std::string::npos) return std::nullopt;
  const char* const end = listen.data() + listen.size();
  std::uint16_t port = 0;
  if (const auto read = std::from_chars(listen.data() + colon + 1, end, port);
      read.ec != std::errc() || read.ptr != end || port == 0) {
    return std::nullopt;
  }
  const std::string host = listen.substr(0, colon);
  SocketAddress address;
  if (host == "[::1]") {
    auto& ip6 = reinterpret_cast<sockaddr_in6&>(address.storage);
    ip6.sin6_family = AF_INET6;
    ip6.sin6_addr = in6addr_loopback;
    ip6.sin6_port = htons(port);
    address.bytes = sizeof ip6;
    return address;
  }
  auto& ip4 = reinterpret_cast<sockaddr_in&>(address.storage);
  ip4.sin_family = AF_INET;
  ip4.sin_port = htons(port);
  address.bytes = sizeof ip4;
  const std::string literal = host == "*" || host == "localhost" ? "127.0.0.1" : host;
  const bool is_loopback =
      literal.starts_with("127.") && ::inet_pton(AF_INET, literal.c_str(), &ip4.sin_addr) == 1;
  return is_loopback ? std::optional(address) : std::nullopt;
}

// Waits until the socket can be read or written.
bool wait_for(int descriptor, decltype(pollfd::events) events, SteadyClock::time_point deadline) {
  for (;;) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - SteadyClock::now());
    if (left.count() <= 0) return false;
    pollfd waiting{descriptor, events, 0};
    const int ready = ::poll(&waiting, 1, static_cast<int>(left.count()));
    if (ready > 0) return true;
    if (ready == 0 || errno != EINTR) return false;
  }
}

bool connect_to(int descriptor, const SocketAddress& address, SteadyClock::time_point deadline) {
  if (::connect(descriptor, reinterpret_cast<const sockaddr*>(&address.storage), address.bytes) == 0)
    return true;
  if (errno != EINPROGRESS) return false;
  if (!wait_for(descriptor, POLLOUT, deadline)) {
    errno = ETIMEDOUT;
    return false;
  }
  int error = 0;
  socklen_t bytes = sizeof error;
  ::getsockopt(descriptor, SOL_SOCKET, SO_ERROR, &error, &bytes);
  errno = error;
  return error == 0;
}

std::string read_answer(int descriptor, SteadyClock::time_point deadline) {
  constexpr std::size_t kMaxAnswerBytes = 256UL * 1024;
  std::string answer;
  std::array<char, 4096> part{};
  while (answer.size() < kMaxAnswerBytes && wait_for(descriptor, POLLIN, deadline)) {
    const ssize_t count = ::recv(descriptor, part.data(), part.size(), 0);
    if (count == 0 || (count < 0 && errno != EINTR && errno != EAGAIN)) break;
    if (count > 0) answer.append(part.data(), static_cast<std::size_t>(count));
  }
  return answer;
}

std::string ask(const std::string& listen, const SocketAddress& address, SteadyClock::time_point deadline) {
  constexpr std::string_view kRequest =
      "GET /health HTTP/1.1\r\nHost: localhost\r\nAccept: application/json\r\nConnection: close\r\n\r\n";
  const std::string place = "The hub at " + listen;
  const FileDescriptor socket(
      ::socket(address.storage.ss_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (!socket.is_open() || !connect_to(socket.number(), address, deadline))
    return place + " does not answer: " + std::system_category().message(errno) + "\n";
  if (::send(socket.number(), kRequest.data(), kRequest.size(), MSG_NOSIGNAL) !=
      static_cast<ssize_t>(kRequest.size())) {
    return place + " took no request.\n";
  }
  const std::string answer = read_answer(socket.number(), deadline);
  return answer.empty() ? place + " did not answer in time.\n" : place + " answered:\n\n" + answer + "\n";
}

}  // namespace

std::string ask_hub_health(const std::vector<std::string>& listen, std::chrono::milliseconds limit) {
  const SteadyClock::time_point deadline = SteadyClock::now() + limit;
  for (const std::string& text : listen) {
    if (const std::optional<SocketAddress> address = local_address(text))
      return ask(text, *address, deadline);
  }
  return "The hub was not asked: the station file names no address of this machine under hub.listen.\n";
}

}  // namespace traygauge
