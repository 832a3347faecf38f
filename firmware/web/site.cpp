#include "firmware/web/site.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <string_view>
#include <utility>

namespace traygauge {
namespace {

// Scripts, styles and pictures of the page itself, nothing from elsewhere, nothing in line, in no other page.
constexpr std::string_view kPagePolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; font-src 'self'; "
    "connect-src 'self'; manifest-src 'self'; form-action 'self'; base-uri 'none'; frame-ancestors 'none'";

HttpResponse protect(HttpResponse response) {
  response.headers.emplace_back("Content-Security-Policy", kPagePolicy);
  response.headers.emplace_back("X-Content-Type-Options", "nosniff");
  response.headers.emplace_back("Referrer-Policy", "no-referrer");
  response.headers.emplace_back("X-Frame-Options", "DENY");
  response.headers.emplace_back("Cross-Origin-Resource-Policy", "same-origin");
  return response;
}

std::optional<HttpResponse> protect(std::optional<HttpResponse> response) {
  if (!response) return std::nullopt;
  return protect(std::move(*response));
}

HttpResponse refuse_method(const std::vector<std::string>& methods) {
  std::string allowed;
  for (const std::string& method : methods) allowed += (allowed.empty() ? "" : ", ") + method;
  HttpResponse response =
      error_response(405, "method_not_allowed", "This address answers " + allowed + " alone.");
  response.headers.emplace_back("Allow", allowed);
  return response;
}

bool is_get(const HttpRequest& request) {
  return request.method == "GET" || request.is_head();
}

}  // namespace

Site::Site(SiteParams params, Access& access, const Router& router, const StaticFiles& files,
           EventStreams& events)
    : hosts_(std::move(params.host_names)),
      base_(std::move(params.base_path)),
      access_(access),
      router_(router),
      files_(files),
      events_(events),
      token_changes_(access.token_changes()) {}

std::optional<HttpResponse> Site::admit(HttpRequest& request) {
  take_base_path_off(request);
  return protect(refuse(request));
}

void Site::take_base_path_off(HttpRequest& request) const {
  auto& segments = request.segments;
  if (base_.empty() || segments.size() < base_.size()) return;
  if (std::equal(base_.begin(), base_.end(), segments.begin()))
    segments.erase(segments.begin(), segments.begin() + static_cast<std::ptrdiff_t>(base_.size()));
}

std::optional<HttpResponse> Site::refuse(HttpRequest& request) {
  if (auto refusal = refuse_foreign(request, hosts_)) return refusal;
  FoundRoute found = router_.find(request.method, request.segments);
  if (found.route != nullptr) {
    request.max_body_bytes = found.route->max_body_bytes;
    request.path_parameters = std::move(found.parameters);
    return access_.admit(request, found.route->minimum, std::chrono::steady_clock::now());
  }
  if (!found.methods.empty()) return refuse_method(found.methods);
  if (!files_.holds(request)) return error_response(404, "not_found", "There is nothing at this address.");
  return is_get(request) ? std::nullopt : std::optional(refuse_method({"GET", "HEAD"}));
}

HttpResponse Site::answer(HttpRequest& request) {
  const FoundRoute found = router_.find(request.method, request.segments);
  return protect(found.route != nullptr ? found.route->answer(request) : files_.answer(request));
}

void Site::attend(SteadyTime now) {
  access_.refresh(now);
  const std::uint64_t changes = access_.token_changes();
  if (std::exchange(token_changes_, changes) != changes) events_.close_all();
  events_.attend(now);
}

}  // namespace traygauge
