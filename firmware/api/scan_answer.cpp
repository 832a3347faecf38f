#include "firmware/api/scan_answer.hpp"

#include <nlohmann/json.hpp>

#include "firmware/base/json_number.hpp"
#include "firmware/base/scan_id.hpp"
#include "firmware/base/time_zone.hpp"
#include "firmware/base/wall_clock.hpp"

namespace traygauge {
namespace {

using Json = nlohmann::ordered_json;

Json id_or_null(const std::optional<ScanId>& id) {
  return id ? Json(scan_id_text(*id)) : Json();
}

Json item_answer(const CorrectedItem& item) {
  return {{"label", item.label},
          {"dish", item.dish},
          {"status", item.status},
          {"food", text_or_null(item.food)},
          {"volume_ml", value_or_null(item.volume_ml)},
          {"sigma_ml", value_or_null(item.sigma_ml)},
          {"is_wrong", item.is_wrong},
          {"measured_food", text_or_null(item.measured_food)},
          {"measured_volume_ml", value_or_null(item.measured_volume_ml)},
          {"measured_sigma_ml", value_or_null(item.measured_sigma_ml)},
          {"split_from", value_or_null(item.split_from)},
          {"merged", item.merged}};
}

HttpResponse no_such_scan(const std::string& id) {
  return error_response(404, "no_such_scan", "No scan is called " + id + ".");
}

}  // namespace

Json text_or_null(const std::string& text) {
  return text.empty() ? Json() : Json(text);
}

Expected<Json> scan_answer(Store& store, const StoredScan& scan) {
  const Expected<CorrectedScan> corrected = store.corrections().corrected(scan);
  if (!corrected.ok()) return Failure{corrected.failure()};
  const Json document = Json::parse(scan.document, nullptr, false);
  const auto of_document = [&document](const char* key) {
    return document.is_object() && document.contains(key) ? document[key] : Json();
  };
  Json json = {{"id", scan_id_text(scan.id)},
               {"station", scan.id.station},
               {"number", scan.id.number},
               {"taken_at", utc_text(scan.taken.unix_ms)},
               {"taken_at_local", local_text(scan.taken.unix_ms)},
               {"clock_synchronised", scan.taken.synchronised},
               {"received_at", utc_text(scan.received.unix_ms)},
               {"tray", of_document("tray")},
               {"status", scan.status},
               {"message", of_document("message")},
               {"supersedes", id_or_null(scan.supersedes)},
               {"superseded_by", id_or_null(scan.superseded_by)},
               {"is_corrected", scan.is_corrected},
               {"is_wrong", scan.is_wrong},
               {"volume_ml", booked_volume_ml(*corrected)},
               {"items", Json::array()},
               {"warnings", of_document("warnings")},
               {"checks", of_document("checks")},
               {"blur_px", of_document("blur_px")},
               {"board", of_document("board")},
               {"duration_ms", of_document("duration_ms")},
               {"timing_ms", of_document("timing_ms")}};
  for (const CorrectedItem& item : corrected->items) json["items"].push_back(item_answer(item));
  return json;
}

HttpResponse answer_scan(Store& store, const StoredScan& scan, int status) {
  const Expected<Json> json = scan_answer(store, scan);
  return json.ok() ? json_answer(*json, status) : store_failure(json.failure());
}

HttpResponse with_scan(HubStore& hub, const HttpRequest& request,
                       const std::function<HttpResponse(Store&, const StoredScan&)>& use) {
  Store* const store = hub.store();
  if (store == nullptr) return store_failure(hub.problem());
  const std::string& text = *request.path_parameter("id");
  const std::optional<ScanId> id = parse_scan_id(text);
  if (!id) return no_such_scan(text);
  const Expected<std::optional<StoredScan>> scan = store->scans().find(*id);
  if (!scan.ok()) return store_failure(scan.failure());
  return *scan ? use(*store, **scan) : no_such_scan(text);
}

HttpResponse json_answer(const Json& json, int status) {
  return json_response(json.dump(-1, ' ', false, Json::error_handler_t::replace), status);
}

HttpResponse store_failure(const std::string& text) {
  return error_response(503, "store", text);
}

HttpResponse wrong_request(const std::string& text) {
  return error_response(400, "wrong_request", text);
}

}  // namespace traygauge
