#include <nlohmann/json.hpp>

#include "firmware/api/hub_site.hpp"
#include "firmware/api/scan_answer.hpp"

namespace traygauge {
namespace {

HttpResponse answer_site(const SiteFacts& facts) {
  return json_answer({{"name", text_or_null(facts.name)},
                      {"time_zone", text_or_null(facts.time_zone)},
                      {"program", facts.program_version},
                      {"commit", text_or_null(facts.commit)},
                      {"configuration_problem", text_or_null(facts.configuration_problem)}});
}

}  // namespace

void add_site_routes(Router& router, const HubSite& site) {
  router.add({"GET", "/api/v1/site", Role::view, 0,
              [&facts = site.facts](const HttpRequest&) { return answer_site(facts); }});
}

}  // namespace traygauge
