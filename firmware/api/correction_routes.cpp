#include <nlohmann/json.hpp>

#include "firmware/api/hub_site.hpp"
#include "firmware/api/scan_answer.hpp"

namespace traygauge {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMaxCorrectionBytes =
    8192;  // author and reason are 1,200 bytes at most, 198 labels 800

std::string text_of(const Json& json, const char* key) {
  return json.contains(key) && json[key].is_string() ? json[key].get<std::string>() : std::string();
}

Json correction_answer(const Correction& correction) {
  Json json = Json::parse(correction_json(correction.action));
  json["correction"] = correction.number;
  json["made_at"] = utc_text(correction.made.unix_ms);
  json["author"] = correction.author;
  json["reason"] = correction.reason;
  return json;
}

HttpResponse list_corrections(HubStore& hub, const HttpRequest& request) {
  Store* const store = hub.store();
  if (store == nullptr) return store_failure(hub.problem());
  const std::string& text = *request.path_parameter("id");
  const std::optional<ScanId> id = parse_scan_id(text);
  if (!id) return no_such_scan(text);
  const Expected<std::optional<StoredScan>> scan = store->scans().find(*id);
  if (!scan.ok()) return store_failure(scan.failure());
  if (!*scan) return no_such_scan(text);
  const Expected<std::vector<Correction>> corrections = store->corrections().list(*id);
  if (!corrections.ok()) return store_failure(corrections.failure());
  Json json = {{"corrections", Json::array()}};
  for (const Correction& correction : *corrections)
    json["corrections"].push_back(correction_answer(correction));
  return json_answer(json);
}

HttpResponse add_correction(const HubSite& site, const HttpRequest& request) {
  Store* const store = site.store.store();
  if (store == nullptr) return store_failure(site.store.problem());
  const std::string& text = *request.path_parameter("id");
  const std::optional<ScanId> id = parse_scan_id(text);
  if (!id) return no_such_scan(text);
  const Expected<std::optional<StoredScan>> found = store->scans().find(*id);
  if (!found.ok()) return store_failure(found.failure());
  if (!*found) return no_such_scan(text);
  const Json body = Json::parse(request.body, nullptr, false);
  if (!body.is_object()) return wrong_request("expected a JSON object, found something else");
  const Expected<CorrectionAction> action = parse_correction(request.body);
  if (!action.ok()) return wrong_request(action.failure());
  // Who holds a named token cannot sign with another's name.
  const std::string author = request.token_name.empty() ? text_of(body, "author") : request.token_name;
  const Expected<BookedCorrection> booked =
      store->corrections().add(*id, *action, author, text_of(body, "reason"), site.wall_clock());
  if (!booked.ok()) return store_failure(booked.failure());
  if (!booked->refusal.empty()) return error_response(409, "refused", booked->refusal);
  site.events.broadcast({"correction", Json{{"id", text}}.dump(), {}});
  const Expected<std::optional<StoredScan>> scan = store->scans().find(*id);
  if (!scan.ok()) return store_failure(scan.failure());
  const Expected<Json> json = scan_answer(*store, **scan);
  return json.ok() ? json_answer(*json, 201) : store_failure(json.failure());
}

}  // namespace

void add_correction_routes(Router& router, const HubSite& site) {
  router.add(
      {"GET", "/api/v1/scans/{id}/corrections", Role::view, 0,
       [&store = site.store](const HttpRequest& request) { return list_corrections(store, request); }});
  router.add({"POST", "/api/v1/scans/{id}/corrections", Role::manage, kMaxCorrectionBytes,
              [&site](const HttpRequest& request) { return add_correction(site, request); }});
}

}  // namespace traygauge
