// The API's description, for who writes a client.
#include <memory>
#include <string>

#include "firmware/api/description_text.hpp"
#include "firmware/api/hub_site.hpp"

namespace traygauge {
namespace {

HttpResponse answer_description() {
  static const auto text = std::make_shared<const std::string>(description_text());
  HttpResponse response;
  response.content_type = "application/yaml";
  response.headers.emplace_back("Cache-Control", "no-cache");
  response.body = text;
  return response;
}

}  // namespace

void add_description_route(Router& router) {
  router.add({"GET", "/api/v1/openapi.yaml", Role::view, 0,
              [](const HttpRequest&) { return answer_description(); }});
}

}  // namespace traygauge
