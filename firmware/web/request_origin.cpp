#include "firmware/web/request_origin.hpp"

#include <algorithm>
#include <utility>

namespace traygauge {
namespace {

std::string lower_host(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + ('a' - 'A')) : c; });
  return lower;
}

// "[::1]:8080" → "[::1]", "hub.local.:80" → "hub.local".
std::string_view without_port(std::string_view host) {
  const std::size_t bracket = host.rfind(']');
  const std::size_t colon = host.find(':', bracket == std::string_view::npos ? 0 : bracket);
  host = host.substr(0, colon);
  if (host.ends_with('.')) host.remove_suffix(1);
  return host;
}

bool is_reading(const HttpRequest& request) {
  return request.method == "GET" || request.method == "HEAD";
}

bool is_own_origin(std::string_view origin, const HttpRequest& request, const OwnHosts& hosts) {
  const std::size_t scheme = origin.find("://");
  if (scheme == std::string_view::npos) return false;  // "null": a page without an origin
  const std::string own = lower_host(origin.substr(scheme + 3));
  for (const char* const name : {"host", "x-forwarded-host"}) {
    const std::string* const host = request.header(name);
    if (host != nullptr && own == lower_host(*host)) return true;
  }
  // A proxy may have put another name into Host. Where it is the same name, the port differs: another
  // program.
  const std::string* const host = request.header("host");
  const bool is_renamed = host == nullptr || lower_host(without_port(*host)) != without_port(own);
  return is_renamed && hosts.has_name(own);
}

HttpResponse refuse_cross_site() {
  return error_response(403, "cross_site", "A page of another site sent this request.");
}

}  // namespace

OwnHosts::OwnHosts(std::vector<std::string> names) : names_(std::move(names)) {
  for (std::string& name : names_) name = lower_host(name);
}

bool OwnHosts::has_name(std::string_view host) const {
  return std::find(names_.begin(), names_.end(), lower_host(without_port(host))) != names_.end();
}

bool OwnHosts::holds(std::string_view host) const {
  std::string_view name = without_port(host);
  if (lower_host(name) == "localhost" || has_name(host)) return true;
  const bool in_brackets = name.size() > 2 && name.front() == '[' && name.back() == ']';
  if (in_brackets) name = name.substr(1, name.size() - 2);
  return PeerAddress::parse(name).has_value();
}

std::optional<HttpResponse> refuse_foreign(const HttpRequest& request, const OwnHosts& hosts) {
  const std::string* const host = request.header("host");
  if (host != nullptr && !hosts.holds(*host))
    return error_response(
        421, "unknown_host",
        "The hub does not know the name by which it was asked: add it to the names of the hub.");
  const std::string* const site = request.header("sec-fetch-site");
  const std::string* const mode = request.header("sec-fetch-mode");
  if (is_reading(request)) {
    // A link on another site may lead here; its pages and scripts may not read from here.
    const bool is_link = mode != nullptr && *mode == "navigate";
    return site != nullptr && *site == "cross-site" && !is_link ? std::optional(refuse_cross_site())
                                                                : std::nullopt;
  }
  // No page can forge what the browser says itself.
  if (site != nullptr)
    return *site != "same-origin" && *site != "none" ? std::optional(refuse_cross_site()) : std::nullopt;
  const std::string* const origin = request.header("origin");
  if (origin != nullptr && !is_own_origin(*origin, request, hosts)) return refuse_cross_site();
  return std::nullopt;
}

}  // namespace traygauge
