#include <nlohmann/json.hpp>

#include "firmware/api/hub_site.hpp"
#include "firmware/api/scan_answer.hpp"
#include "firmware/config/setup_progress.hpp"

namespace traygauge {
namespace {

using Json = nlohmann::ordered_json;

// Read again each time: somebody may be at it.
Json setup_of(const SiteFacts& facts) {
  if (facts.station_file.empty()) return nullptr;
  const auto progress = read_setup_progress(facts.station_file);
  if (!progress) return nullptr;
  return {{"card", progress->has_card}, {"lens", progress->has_lens}, {"arm", progress->has_arm}};
}

HttpResponse answer_site(const SiteFacts& facts) {
  return json_answer({{"name", text_or_null(facts.name)},
                      {"time_zone", text_or_null(facts.time_zone)},
                      {"program", facts.program_version},
                      {"commit", text_or_null(facts.commit)},
                      {"configuration_problem", text_or_null(facts.configuration_problem)},
                      {"setup", setup_of(facts)}});
}

}  // namespace

void add_site_routes(Router& router, const HubSite& site) {
  router.add({"GET", "/api/v1/site", Role::view, 0,
              [&facts = site.facts](const HttpRequest&) { return answer_site(facts); }});
}

}  // namespace traygauge
