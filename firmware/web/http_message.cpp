#include "firmware/web/http_message.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <utility>

namespace traygauge {

bool is_kept_header(std::string_view lower_case_name) {
  static constexpr auto kNames = std::to_array<std::string_view>(
      {"accept", "accept-language", "authorization", "content-type", "cookie", "forwarded", "host",
       "if-none-match", "last-event-id", "origin", "sec-fetch-mode", "sec-fetch-site", "via",
       "x-forwarded-for", "x-forwarded-host", "x-forwarded-proto", "x-real-ip"});
  return std::find(kNames.begin(), kNames.end(), lower_case_name) != kNames.end();
}

HttpResponse json_response(std::string json, int status) {
  HttpResponse response;
  response.status = status;
  response.headers.emplace_back("Cache-Control", "no-store");
  response.body = std::move(json);
  return response;
}

HttpResponse error_response(int status, std::string_view code, std::string_view message) {
  const nlohmann::ordered_json document = {{"error", {{"code", code}, {"message", message}}}};
  using Json = nlohmann::ordered_json;
  return json_response(document.dump(-1, ' ', false, Json::error_handler_t::replace), status);
}

}  // namespace traygauge
