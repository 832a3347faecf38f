#include "firmware/webhook/webhook_address.hpp"

#include <algorithm>
#include <optional>

#include "firmware/base/this_machine.hpp"

namespace traygauge {
namespace {

constexpr std::size_t kMaxCharacters = 2000;

bool is_visible(char c) {
  return c > ' ' && c < '\x7f';
}

bool is_host_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '-' ||
         c == '_';
}

bool is_literal_character(char c) {
  return (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F') || (c >= '0' && c <= '9') || c == '.' || c == ':';
}

bool is_port(std::string_view text) {
  constexpr int kMaxPort = 65535;
  constexpr std::size_t kMaxDigits = 5;
  if (text.empty() || text.size() > kMaxDigits) return false;
  int port = 0;
  for (const char c : text) {
    if (c < '0' || c > '9') return false;
    port = port * 10 + (c - '0');
  }
  return port >= 1 && port <= kMaxPort;
}

struct HostAndPort {
  std::string_view host;  // without brackets
  bool is_literal = false;
  std::string_view port;  // with its colon; empty: the scheme's
};

std::optional<HostAndPort> split(std::string_view authority) {
  HostAndPort parts;
  std::size_t end = 0;
  if (authority.starts_with('[')) {
    end = authority.find(']');
    if (end == std::string_view::npos) return std::nullopt;
    parts.host = authority.substr(1, end - 1);
    parts.is_literal = true;
    ++end;
  } else {
    end = std::min(authority.find(':'), authority.size());
    parts.host = authority.substr(0, end);
  }
  parts.port = authority.substr(end);
  const bool is_host = std::all_of(parts.host.begin(), parts.host.end(),
                                   parts.is_literal ? is_literal_character : is_host_character);
  if (parts.host.empty() || !is_host) return std::nullopt;
  if (!parts.port.empty() && (parts.port.front() != ':' || !is_port(parts.port.substr(1))))
    return std::nullopt;
  return parts;
}

}  // namespace

Expected<WebhookAddress> parse_webhook_address(std::string_view text) {
  constexpr std::string_view kHttps = "https://";
  constexpr std::string_view kHttp = "http://";
  WebhookAddress address;
  address.text = text;
  address.is_encrypted = text.starts_with(kHttps);
  if (!address.is_encrypted && !text.starts_with(kHttp))
    return Failure{"one that begins neither with https:// nor with http://"};
  if (text.size() > kMaxCharacters || !std::all_of(text.begin(), text.end(), is_visible))
    return Failure{"spaces or other characters that no address has, or more than " +
                   std::to_string(kMaxCharacters)};
  if (text.find('#') != std::string_view::npos) return Failure{"'#', whose rest would not be sent"};
  const std::string_view scheme = address.is_encrypted ? kHttps : kHttp;
  std::string_view authority = text.substr(scheme.size());
  authority = authority.substr(0, authority.find_first_of("/?"));
  // A user and a password may stand before the host.
  if (const std::size_t at = authority.rfind('@'); at != std::string_view::npos)
    authority.remove_prefix(at + 1);
  const std::optional<HostAndPort> parts = split(authority);
  if (!parts) return Failure{"one without a host that can be asked for"};
  address.is_local = is_this_machine(parts->host);
  address.shown = std::string(scheme) + std::string(authority);
  return address;
}

}  // namespace traygauge
