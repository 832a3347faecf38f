// Who is at the other end of a connection, and ranges of such addresses.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

struct sockaddr;

namespace traygauge {

// An IP address, IPv4 as ::ffff:a.b.c.d, or the other end of a Unix socket.
class PeerAddress {
 public:
  using Bytes = std::array<std::uint8_t, 16>;

  // A Unix socket's.
  PeerAddress() = default;
  explicit PeerAddress(const Bytes& bytes) : bytes_(bytes), is_local_socket_(false) {}
  // Of AF_INET, AF_INET6 or AF_UNIX; none for other families.
  static std::optional<PeerAddress> of(const sockaddr& address);
  // "192.0.2.1", "2001:db8::1"; none where the text is no literal address.
  static std::optional<PeerAddress> parse(std::string_view text);

  bool is_local_socket() const { return is_local_socket_; }
  bool is_ip4() const;
  bool is_loopback() const;
  // On this machine: loopback or a Unix socket.
  bool is_local() const { return is_local_socket_ || is_loopback(); }
  const Bytes& bytes() const { return bytes_; }
  // What one customer of a provider has: an IPv4 address, the /64 of an IPv6 address.
  PeerAddress neighbourhood() const;
  std::string text() const;

  friend bool operator==(const PeerAddress&, const PeerAddress&) = default;
  friend bool operator<(const PeerAddress& a, const PeerAddress& b) {
    return std::tie(a.is_local_socket_, a.bytes_) < std::tie(b.is_local_socket_, b.bytes_);
  }

 private:
  Bytes bytes_{};
  bool is_local_socket_ = true;
};

// "10.0.0.0/8", "fd00::/8", one address, or "unix": all Unix sockets.
class AddressRange {
 public:
  static std::optional<AddressRange> parse(std::string_view text);
  bool holds(const PeerAddress& address) const;

 private:
  AddressRange(const PeerAddress& first, unsigned bits) : first_(first), bits_(bits) {}
  PeerAddress first_;
  unsigned bits_ = 0;
};

bool is_in_any(const std::vector<AddressRange>& ranges, const PeerAddress& address);
// 127.0.0.0/8, ::1 and Unix sockets.
std::vector<AddressRange> local_ranges();

}  // namespace traygauge
