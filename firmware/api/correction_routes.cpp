#include <nlohmann/json.hpp>

#include "firmware/api/hub_site.hpp"
#include "firmware/api/scan_answer.hpp"
#include "firmware/base/json_reading.hpp"

namespace traygauge {
namespace {

using Json = nlohmann::ordered_json;

// Author and reason are 1,200 bytes at most, 198 labels 800.
constexpr std::size_t kMaxCorrectionBytes = 8192;

Json correction_answer(const Correction& correction) {
  Json json = Json::parse(correction_json(correction.action));
  json["correction"] = correction.number;
  json["made_at"] = utc_text(correction.made.unix_ms);
  json["author"] = correction.author;
  json["reason"] = correction.reason;
  return json;
}

HttpResponse list_corrections(Store& store, const StoredScan& scan) {
  const Expected<std::vector<Correction>> corrections = store.corrections().list(scan);
  if (!corrections.ok()) return store_failure(corrections.failure());
  Json json = {{"corrections", Json::array()}};
  for (const Correction& correction : *corrections)
    json["corrections"].push_back(correction_answer(correction));
  return json_answer(json);
}

HttpResponse add_correction(const HubSite& site, const HttpRequest& request, Store& store, const ScanId& id) {
  const Json body = Json::parse(request.body, nullptr, false);
  if (!body.is_object()) return wrong_request("expected a JSON object, found something else");
  const Expected<CorrectionAction> action = parse_correction(request.body);
  if (!action.ok()) return wrong_request(action.failure());
  // Who holds a named token cannot sign with another's name.
  const std::string author = request.token_name.empty() ? json_text(body, "author") : request.token_name;
  const Expected<BookedCorrection> booked =
      store.corrections().add(id, *action, author, json_text(body, "reason"), site.wall_clock());
  if (!booked.ok()) return store_failure(booked.failure());
  if (!booked->refusal.empty()) return error_response(409, "refused", booked->refusal);
  site.drift.note(id);
  site.events.broadcast({"correction", Json{{"id", scan_id_text(id)}}.dump(), {}});
  const Expected<std::optional<StoredScan>> scan = store.scans().find(id);
  return scan.ok() ? answer_scan(store, **scan, 201) : store_failure(scan.failure());
}

}  // namespace

void add_correction_routes(Router& router, const HubSite& site) {
  router.add({"GET", "/api/v1/scans/{id}/corrections", Role::view, 0, [&site](const HttpRequest& request) {
                return with_scan(site.store, request, list_corrections);
              }});
  router.add({"POST", "/api/v1/scans/{id}/corrections", Role::manage, kMaxCorrectionBytes,
              [&site](const HttpRequest& request) {
                return with_scan(site.store, request, [&](Store& store, const StoredScan& scan) {
                  return add_correction(site, request, store, scan.id);
                });
              }});
}

}  // namespace traygauge
