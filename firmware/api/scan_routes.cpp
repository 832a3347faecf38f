#include <charconv>
#include <nlohmann/json.hpp>

#include "firmware/api/history_query.hpp"
#include "firmware/api/hub_site.hpp"
#include "firmware/api/scan_answer.hpp"

namespace traygauge {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kScansAPage = 50;
constexpr std::size_t kMaxScansAPage = 200;

std::optional<std::size_t> page_size(const HttpRequest& request) {
  const std::string* const text = request.parameter("limit");
  if (text == nullptr) return kScansAPage;
  std::size_t size = 0;
  const char* const end = text->data() + text->size();
  const auto [stopped, error] = std::from_chars(text->data(), end, size);
  const bool is_number = error == std::errc() && stopped == end;
  return is_number && size >= 1 && size <= kMaxScansAPage ? std::optional(size) : std::nullopt;
}

HttpResponse latest(HubStore& hub) {
  Store* const store = hub.store();
  if (store == nullptr) return store_failure(hub.problem());
  const Expected<std::optional<StoredScan>> scan = store->scans().latest();
  if (!scan.ok()) return store_failure(scan.failure());
  if (!*scan) return error_response(404, "no_scan_yet", "Nothing has been measured yet.");
  return answer_scan(*store, **scan);
}

HttpResponse history(HubStore& hub, const HttpRequest& request) {
  Store* const store = hub.store();
  if (store == nullptr) return store_failure(hub.problem());
  const Expected<HistoryFilter> filter = parse_history_filter(request, {"limit", "cursor"});
  if (!filter.ok()) return wrong_request(filter.failure());
  const std::optional<std::size_t> size = page_size(request);
  if (!size) return wrong_request("limit: expected 1 to " + std::to_string(kMaxScansAPage));
  std::optional<HistoryCursor> after;
  if (const std::string* const text = request.parameter("cursor")) {
    after = parse_history_cursor(*text);
    if (!after) return wrong_request("cursor: expected `next` of an earlier answer");
  }
  const Expected<HistoryPage> page = store->history().page(*filter, *size, after);
  if (!page.ok()) return store_failure(page.failure());
  Json json = {{"scans", Json::array()}, {"next", nullptr}};
  for (const StoredScan& scan : page->scans) {
    const Expected<Json> one = scan_answer(*store, scan);
    if (!one.ok()) return store_failure(one.failure());
    json["scans"].push_back(*one);
  }
  if (page->next) json["next"] = history_cursor_text(*page->next);
  return json_answer(json);
}

}  // namespace

void add_scan_routes(Router& router, const HubSite& site) {
  HubStore& store = site.store;
  router.add(
      {"GET", "/api/v1/scans/latest", Role::view, 0, [&store](const HttpRequest&) { return latest(store); }});
  router.add({"GET", "/api/v1/scans", Role::view, 0,
              [&store](const HttpRequest& request) { return history(store, request); }});
  router.add({"GET", "/api/v1/scans/{id}", Role::view, 0, [&store](const HttpRequest& request) {
                return with_scan(store, request,
                                 [](Store& open, const StoredScan& scan) { return answer_scan(open, scan); });
              }});
  router.add({"GET", "/api/v1/scans/{id}/document", Role::view, 0, [&store](const HttpRequest& request) {
                return with_scan(store, request,
                                 [](Store&, const StoredScan& scan) { return json_response(scan.document); });
              }});
}

}  // namespace traygauge
