#include "tests/firmware/web/web_client.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>

namespace traygauge::test {
namespace {

using Clock = std::chrono::steady_clock;

bool wait_for(int socket, short events, Clock::time_point end) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - Clock::now()).count();
  pollfd waiting{socket, events, 0};
  return left > 0 && ::poll(&waiting, 1, static_cast<int>(left)) > 0;
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

WebReply parse_head(const std::string& head) {
  WebReply reply;
  reply.status = std::atoi(head.substr(head.find(' ') + 1).c_str());
  for (std::size_t at = head.find("\r\n") + 2; at < head.size();) {
    const std::size_t end = std::min(head.find("\r\n", at), head.size());
    const std::string line = head.substr(at, end - at);
    const std::size_t colon = line.find(':');
    if (colon != std::string::npos)
      reply.headers.emplace_back(lower(line.substr(0, colon)), line.substr(colon + 2));
    at = end + 2;
  }
  return reply;
}

}  // namespace

std::string WebReply::header(std::string_view name) const {
  std::string all;
  for (const auto& [known, value] : headers) {
    if (known == name) all += (all.empty() ? "" : "|") + value;
  }
  return all;
}

WebClient::WebClient(std::uint16_t port, const char* address) {
  sockaddr_in6 ip6{};
  sockaddr_in ip4{};
  ip4.sin_family = AF_INET;
  ip4.sin_port = htons(port);
  const sockaddr* pointer = reinterpret_cast<const sockaddr*>(&ip4);
  socklen_t bytes = sizeof(ip4);
  if (::inet_pton(AF_INET, address, &ip4.sin_addr) != 1) {
    ip6.sin6_family = AF_INET6;
    ip6.sin6_port = htons(port);
    ::inet_pton(AF_INET6, address, &ip6.sin6_addr);
    pointer = reinterpret_cast<const sockaddr*>(&ip6);
    bytes = sizeof(ip6);
  }
  socket_ = ::socket(pointer->sa_family, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (::connect(socket_, pointer, bytes) != 0) ::close(std::exchange(socket_, -1));
}

WebClient::WebClient(const std::filesystem::path& socket) {
  sockaddr_un local{};
  local.sun_family = AF_UNIX;
  std::strncpy(local.sun_path, socket.c_str(), sizeof(local.sun_path) - 1);
  socket_ = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (::connect(socket_, reinterpret_cast<const sockaddr*>(&local), sizeof(local)) != 0)
    ::close(std::exchange(socket_, -1));
}

WebClient::~WebClient() {
  if (socket_ >= 0) ::close(socket_);
}

bool WebClient::send(std::string_view bytes) {
  const auto end = Clock::now() + std::chrono::seconds(5);
  while (!bytes.empty()) {
    const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent > 0) {
      bytes.remove_prefix(static_cast<std::size_t>(sent));
    } else if (errno != EAGAIN || !wait_for(socket_, POLLOUT, end)) {
      return false;
    }
  }
  return true;
}

bool WebClient::read_more(Clock::time_point end) {
  if (is_closed_ || !wait_for(socket_, POLLIN, end)) return false;
  std::array<char, 65536> block{};
  const ssize_t got = ::recv(socket_, block.data(), block.size(), MSG_DONTWAIT);
  if (got <= 0) is_closed_ = true;
  if (got > 0) received_.append(block.data(), static_cast<std::size_t>(got));
  return got > 0;
}

std::string WebClient::receive_until(std::string_view text, Milliseconds timeout) {
  const auto end = Clock::now() + timeout;
  for (;;) {
    const std::size_t at = received_.find(text);
    if (at != std::string::npos) {
      const std::string part = received_.substr(0, at + text.size());
      received_.erase(0, part.size());
      return part;
    }
    if (!read_more(end)) return {};
  }
}

std::optional<WebReply> WebClient::receive(bool is_head, Milliseconds timeout) {
  const auto end = Clock::now() + timeout;
  const std::string head = receive_until("\r\n\r\n", timeout);
  if (head.empty()) return std::nullopt;
  WebReply reply = parse_head(head);
  if (is_head || reply.status == 304 || reply.status == 204) return reply;
  if (reply.status == 100) return reply;
  if (reply.header("transfer-encoding") == "chunked") {
    for (;;) {
      const std::string line = receive_until("\r\n", timeout);
      if (line.empty()) return std::nullopt;
      const auto size = std::strtoul(line.c_str(), nullptr, 16);
      while (received_.size() < size + 2) {
        if (!read_more(end)) return std::nullopt;
      }
      reply.body += received_.substr(0, size);
      received_.erase(0, size + 2);
      if (size == 0) return reply;
    }
  }
  const std::string length = reply.header("content-length");
  const auto size = std::strtoul(length.c_str(), nullptr, 10);
  while (length.empty() ? read_more(end) : received_.size() < size) {
    if (!length.empty() && !read_more(end)) return std::nullopt;
  }
  reply.body = received_.substr(0, length.empty() ? received_.size() : size);
  received_.erase(0, reply.body.size());
  return reply;
}

std::optional<WebReply> WebClient::ask(std::string_view method, std::string_view target,
                                       const std::vector<std::string>& fields, std::string_view body) {
  std::string request = std::string(method) + " " + std::string(target) + " HTTP/1.1\r\n";
  bool has_host = false;
  for (const std::string& field : fields) {
    request += field + "\r\n";
    has_host = has_host || field.starts_with("Host:");
  }
  if (!has_host) request += "Host: localhost\r\n";
  if (!body.empty()) request += "Content-Length: " + std::to_string(body.size()) + "\r\n";
  if (!send(request + "\r\n" + std::string(body))) return std::nullopt;
  return receive(method == "HEAD");
}

bool WebClient::is_closed_within(Milliseconds timeout) {
  const auto end = Clock::now() + timeout;
  while (read_more(end)) received_.clear();
  return is_closed_;
}

}  // namespace traygauge::test
