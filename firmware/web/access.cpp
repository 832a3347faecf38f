#include "firmware/web/access.hpp"

#include <strings.h>

#include <algorithm>
#include <array>
#include <utility>

namespace traygauge {
namespace {

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

// "192.0.2.1", "192.0.2.1:4711", "2001:db8::1" or "[2001:db8::1]:4711", as proxies write them.
std::optional<PeerAddress> forwarded_address(std::string_view text) {
  text = trimmed(text);
  if (text.starts_with('[')) {
    const std::size_t end = text.find(']');
    return end == std::string_view::npos ? std::nullopt : PeerAddress::parse(text.substr(1, end - 1));
  }
  const bool has_port = std::count(text.begin(), text.end(), ':') == 1;
  return PeerAddress::parse(has_port ? text.substr(0, text.find(':')) : text);
}

// All X-Forwarded-For fields in one, as they were added.
std::string forwarded_list(const HttpRequest& request) {
  std::string list;
  for (const auto& [name, value] : request.headers) {
    if (name == "x-forwarded-for") list += (list.empty() ? "" : ",") + value;
  }
  return list;
}

bool says_forwarded(const HttpRequest& request) {
  constexpr auto kNames = std::to_array<std::string_view>(
      {"x-forwarded-for", "x-forwarded-host", "x-forwarded-proto", "x-real-ip", "forwarded", "via"});
  return std::any_of(kNames.begin(), kNames.end(),
                     [&request](std::string_view name) { return request.header(name) != nullptr; });
}

HttpResponse refuse_unknown(std::string_view code, std::string_view message) {
  HttpResponse response = error_response(401, code, message);
  response.headers.emplace_back("WWW-Authenticate", "Bearer realm=\"traygauge\"");
  return response;
}

}  // namespace

Access::Access(AccessParams params)
    : params_(std::move(params)), tokens_(params_.token_files), attempts_(params_.attempts) {}

Expected<void> Access::check_listen(const std::vector<ListenAddress>& addresses) {
  Expected<void> read = tokens_.read();
  if (!read.ok()) return read;
  if (tokens_.are_configured()) return {};
  if (params_.local == LocalRule::tokens)
    return Failure{"access: tokens are demanded on this machine, but no token file is named; name one"};
  for (const ListenAddress& address : addresses) {
    if (!address.is_local())
      return Failure{address.text() +
                     ": others on the network reach this address, and no token file is named: name one, or "
                     "listen on 127.0.0.1 alone"};
  }
  return {};
}

// From the nearest proxy outward, as long as each is trusted: what is further left, anybody may have written.
Client Access::client_of(const HttpRequest& request) const {
  Client client{request.peer, says_forwarded(request)};
  const std::string list = forwarded_list(request);
  std::string_view rest = list;
  while (!rest.empty() && is_in_any(params_.trusted_proxies, client.address)) {
    const std::size_t comma = rest.rfind(',');
    const auto address = forwarded_address(comma == std::string_view::npos ? rest : rest.substr(comma + 1));
    if (!address) break;
    client.address = *address;
    rest = comma == std::string_view::npos ? std::string_view() : rest.substr(0, comma);
  }
  return client;
}

bool Access::is_open_to(const Client& client) const {
  if (client.is_forwarded || !client.address.is_local()) return false;
  if (params_.local == LocalRule::open_without_tokens) return !tokens_.are_configured();
  return params_.local == LocalRule::open;
}

std::optional<HttpResponse> Access::admit(HttpRequest& request, Role minimum, SteadyTime now) {
  const Client client = client_of(request);
  request.client = client.address.text();
  if (minimum == Role::none) return std::nullopt;
  if (is_open_to(client)) {
    request.role = Role::manage;
    return std::nullopt;
  }
  if (!tokens_.are_configured())
    return refuse_unknown("no_tokens",
                          "This request came through a proxy, and the hub has no tokens: name a token file.");
  const std::optional<std::string_view> token = token_of(request);
  if (!token) return refuse_unknown("token_needed", "A token is needed: log in.");
  Login login = log_in(request, *token, now);
  if (login.refusal) return std::move(login.refusal);
  request.role = login.holder.role;
  request.token_name = std::move(login.holder.name);
  if (is_enough(request.role, minimum)) return std::nullopt;
  return error_response(403, "role_too_low", "This token may only look; a token that manages is needed.");
}

Access::Login Access::log_in(const HttpRequest& request, std::string_view token, SteadyTime now) {
  tokens_.refresh(now);
  const PeerAddress address = client_of(request).address;
  if (!attempts_.may_try(address, now)) {
    HttpResponse wait =
        error_response(429, "too_many_attempts", "Too many wrong tokens came from here: wait a moment.");
    const auto seconds = std::chrono::ceil<std::chrono::seconds>(params_.attempts.interval).count();
    wait.headers.emplace_back("Retry-After", std::to_string(seconds));
    return {{}, std::move(wait)};
  }
  if (auto holder = tokens_.find(token)) return {std::move(*holder), std::nullopt};
  attempts_.note_failure(address, now);
  return {{}, refuse_unknown("token_unknown", "This token is not known, or not any more: log in again.")};
}

std::optional<std::string_view> cookie_token_of(const HttpRequest& request) {
  for (const auto& [name, value] : request.headers) {
    if (name != "cookie") continue;
    for (std::string_view rest = value; !rest.empty();) {
      const std::size_t end = std::min(rest.find(';'), rest.size());
      const std::string_view pair = trimmed(rest.substr(0, end));
      rest.remove_prefix(std::min(end + 1, rest.size()));
      const std::size_t equals = pair.find('=');
      if (equals != std::string_view::npos && pair.substr(0, equals) == kTokenCookie)
        return pair.substr(equals + 1);
    }
  }
  return std::nullopt;
}

std::optional<std::string_view> token_of(const HttpRequest& request) {
  constexpr std::string_view kScheme = "Bearer ";
  if (const std::string* const field = request.header("authorization")) {
    const bool is_bearer =
        field->size() > kScheme.size() && ::strncasecmp(field->c_str(), kScheme.data(), kScheme.size()) == 0;
    if (is_bearer) return trimmed(std::string_view(*field).substr(kScheme.size()));
  }
  return cookie_token_of(request);
}

}  // namespace traygauge
