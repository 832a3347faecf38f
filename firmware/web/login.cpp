#include "firmware/web/login.hpp"

#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace traygauge {
namespace {

constexpr std::size_t kMaxLoginBytes = 1024;

std::string life_of(Role role) {
  using std::chrono::days;
  using std::chrono::seconds;
  if (role == Role::manage) return {};
  const seconds life = role == Role::kiosk ? days(400) : days(30);
  return "; Max-Age=" + std::to_string(life.count());
}

// Of a page that came by HTTPS the cookie never goes by plain HTTP. A proxy says so; who claims it wrongly
// makes but their own cookie unusable.
std::string secure_of(const HttpRequest& request) {
  const std::string* const scheme = request.header("x-forwarded-proto");
  return scheme != nullptr && *scheme == "https" ? "; Secure" : "";
}

void set_cookie(HttpResponse& response, const HttpRequest& request, std::string_view token,
                const std::string& life) {
  response.headers.emplace_back("Set-Cookie", std::string(kTokenCookie) + "=" + std::string(token) +
                                                  "; HttpOnly; SameSite=Strict" + life + secure_of(request));
}

HttpResponse who_response(Role role, const std::string& name) {
  const nlohmann::ordered_json who = {{"role", role_name(role)}, {"name", name}};
  return json_response(who.dump());
}

std::optional<std::string> token_in_body(const std::string& body) {
  const auto document = nlohmann::json::parse(body, nullptr, false);
  if (!document.is_object() || !document.contains("token")) return std::nullopt;
  const auto& token = document.at("token");
  return token.is_string() ? std::optional(token.get<std::string>()) : std::nullopt;
}

HttpResponse log_in(const HttpRequest& request, Access& access) {
  // A form of another site cannot send this type.
  const std::string* const type = request.header("content-type");
  if (type == nullptr || !type->starts_with("application/json"))
    return error_response(415, "json_needed", "Expected a body of the type application/json.");
  const std::optional<std::string> token = token_in_body(request.body);
  if (!token) return error_response(400, "token_missing", "Expected a body {\"token\": \"…\"}.");
  Access::Login login = access.log_in(request, *token, std::chrono::steady_clock::now());
  if (login.refusal) return std::move(*login.refusal);
  HttpResponse response = who_response(login.holder.role, login.holder.name);
  set_cookie(response, request, *token, life_of(login.holder.role));
  return response;
}

HttpResponse log_out(const HttpRequest& request) {
  HttpResponse response = json_response("{}");
  set_cookie(response, request, "", "; Max-Age=0");
  return response;
}

HttpResponse tell_session(const HttpRequest& request) {
  HttpResponse response = who_response(request.role, request.token_name);
  const std::optional<std::string_view> token = cookie_token_of(request);
  const bool is_by_cookie = token && token == token_of(request);
  if (is_by_cookie && request.role == Role::kiosk)
    set_cookie(response, request, *token, life_of(Role::kiosk));
  return response;
}

}  // namespace

void add_login_routes(Router& router, Access& access) {
  router.add({"POST", "/api/v1/login", Role::none, kMaxLoginBytes,
              [&access](const HttpRequest& request) { return log_in(request, access); }});
  router.add({"POST", "/api/v1/logout", Role::none, 0, &log_out});
  router.add({"GET", "/api/v1/session", Role::view, 0, &tell_session});
}

}  // namespace traygauge
