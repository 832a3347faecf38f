#include "firmware/web/peer_address.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstring>

namespace traygauge {
namespace {

constexpr std::array<std::uint8_t, 12> kMappedPrefix{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xFF, 0xFF};

PeerAddress::Bytes mapped(const in_addr& address) {
  PeerAddress::Bytes bytes{};
  std::copy(kMappedPrefix.begin(), kMappedPrefix.end(), bytes.begin());
  std::memcpy(bytes.data() + kMappedPrefix.size(), &address, sizeof(address));
  return bytes;
}

PeerAddress::Bytes plain(const in6_addr& address) {
  PeerAddress::Bytes bytes{};
  std::memcpy(bytes.data(), &address, bytes.size());
  return bytes;
}

bool same_bits(const PeerAddress::Bytes& a, const PeerAddress::Bytes& b, unsigned bits) {
  for (unsigned i = 0; i < bits; ++i) {
    const unsigned mask = 0x80U >> (i % 8);
    if (((a[i / 8] ^ b[i / 8]) & mask) != 0) return false;
  }
  return true;
}

}  // namespace

std::optional<PeerAddress> PeerAddress::of(const sockaddr& address) {
  if (address.sa_family == AF_UNIX) return PeerAddress();
  // NOLINTBEGIN(cppcoreguidelines-pro-type-reinterpret-cast): the kernel's interface
  if (address.sa_family == AF_INET)
    return PeerAddress(mapped(reinterpret_cast<const sockaddr_in*>(&address)->sin_addr));
  if (address.sa_family == AF_INET6)
    return PeerAddress(plain(reinterpret_cast<const sockaddr_in6*>(&address)->sin6_addr));
  // NOLINTEND(cppcoreguidelines-pro-type-reinterpret-cast)
  return std::nullopt;
}

std::optional<PeerAddress> PeerAddress::parse(std::string_view text) {
  if (text.size() >= INET6_ADDRSTRLEN || text.find('\0') != std::string_view::npos) return std::nullopt;
  const std::string terminated(text);
  in_addr ip4{};
  if (::inet_pton(AF_INET, terminated.c_str(), &ip4) == 1) return PeerAddress(mapped(ip4));
  in6_addr ip6{};
  if (::inet_pton(AF_INET6, terminated.c_str(), &ip6) == 1) return PeerAddress(plain(ip6));
  return std::nullopt;
}

bool PeerAddress::is_ip4() const {
  return !is_local_socket_ && std::equal(kMappedPrefix.begin(), kMappedPrefix.end(), bytes_.begin());
}

bool PeerAddress::is_loopback() const {
  if (is_local_socket_) return false;
  if (is_ip4()) return bytes_[kMappedPrefix.size()] == 127;
  return bytes_ == plain(in6addr_loopback);
}

PeerAddress PeerAddress::neighbourhood() const {
  PeerAddress whole = *this;
  if (!is_local_socket_ && !is_ip4()) std::fill(whole.bytes_.begin() + 8, whole.bytes_.end(), 0);
  return whole;
}

std::string PeerAddress::text() const {
  if (is_local_socket_) return "unix";
  std::array<char, INET6_ADDRSTRLEN> text{};
  if (is_ip4()) {
    ::inet_ntop(AF_INET, bytes_.data() + kMappedPrefix.size(), text.data(), text.size());
  } else {
    ::inet_ntop(AF_INET6, bytes_.data(), text.data(), text.size());
  }
  return text.data();
}

std::optional<AddressRange> AddressRange::parse(std::string_view text) {
  if (text == "unix") return AddressRange(PeerAddress(), 0);
  const std::size_t slash = text.find('/');
  const auto first = PeerAddress::parse(text.substr(0, slash));
  if (!first) return std::nullopt;
  constexpr unsigned kAllBits = 128;
  if (slash == std::string_view::npos) return AddressRange(*first, kAllBits);
  const std::string_view digits = text.substr(slash + 1);
  unsigned bits = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), bits);
  const bool is_short = text.find(':') == std::string_view::npos;  // written as IPv4
  if (error != std::errc() || end != digits.data() + digits.size() || bits > (is_short ? 32U : kAllBits))
    return std::nullopt;
  return AddressRange(*first, is_short ? bits + 8 * static_cast<unsigned>(kMappedPrefix.size()) : bits);
}

bool AddressRange::holds(const PeerAddress& address) const {
  if (first_.is_local_socket() || address.is_local_socket())
    return first_.is_local_socket() && address.is_local_socket();
  return same_bits(first_.bytes(), address.bytes(), bits_);
}

bool is_in_any(const std::vector<AddressRange>& ranges, const PeerAddress& address) {
  return std::any_of(ranges.begin(), ranges.end(),
                     [&address](const AddressRange& range) { return range.holds(address); });
}

std::vector<AddressRange> local_ranges() {
  std::vector<AddressRange> ranges;
  for (const char* const text : {"127.0.0.0/8", "::1", "unix"}) ranges.push_back(*AddressRange::parse(text));
  return ranges;
}

}  // namespace traygauge
