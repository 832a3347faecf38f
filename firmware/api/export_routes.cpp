#include <nlohmann/json.hpp>

#include "firmware/api/history_query.hpp"
#include "firmware/api/hub_site.hpp"
#include "firmware/api/scan_answer.hpp"
#include "firmware/base/text.hpp"

namespace traygauge {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kScansAPiece = 16;  // some 10 kB, and 2 ms of the hub's time
constexpr const char* kCsvHead =
    "id,station,number,taken_at,clock_synchronised,received_at,tray,status,supersedes,superseded_by,scan_"
    "wrong,"
    "item,dish,item_status,food,volume_ml,sigma_ml,item_wrong,measured_food,measured_volume_ml\r\n";

// Quoted where it has to be. A table calculation takes a cell that begins so for a formula.
std::string csv_cell(const std::string& text) {
  const bool looks_like_formula =
      !text.empty() && std::string_view("=+-@\t\r").find(text.front()) != std::string_view::npos;
  const bool has_to_be_quoted = text.find_first_of(",\"\r\n") != std::string::npos;
  std::string cell;
  if (has_to_be_quoted) cell += '"';
  if (looks_like_formula) cell += '\'';
  for (const char character : text) {
    if (character == '"') cell += '"';
    cell += character;
  }
  if (has_to_be_quoted) cell += '"';
  return cell;
}

std::string csv_value(const Json& value) {
  if (value.is_null()) return {};
  if (value.is_string()) return csv_cell(value.get<std::string>());
  if (value.is_number_float()) return fixed(value.get<double>(), 1);
  return value.dump();
}

std::string csv_values(const Json& json, std::initializer_list<const char*> keys) {
  std::string text;
  for (const char* const key : keys) {
    if (key != *keys.begin()) text += ',';
    text += csv_value(json[key]);
  }
  return text;
}

// A line for each item; a scan without items has one, too, so that no refusal is hidden.
std::string csv_lines(const Json& scan) {
  const std::string head =
      csv_values(scan, {"id", "station", "number", "taken_at", "clock_synchronised", "received_at", "tray",
                        "status", "supersedes", "superseded_by", "is_wrong"});
  if (scan["items"].empty()) return head + ",,,,,,,,,\r\n";
  std::string lines;
  for (const Json& item : scan["items"]) {
    lines += head + ',' +
             csv_values(item, {"label", "dish", "status", "food", "volume_ml", "sigma_ml", "is_wrong",
                               "measured_food", "measured_volume_ml"}) +
             "\r\n";
  }
  return lines;
}

enum class Format : std::uint8_t { csv, json };

// Goes through the history a few scans at a time, so that an export of years takes no memory.
class Export {
 public:
  Export(HubStore& hub, HistoryFilter filter, Format format)
      : hub_(hub), filter_(std::move(filter)), format_(format) {}

  Expected<std::string> next() {
    if (is_over_) return std::string();
    std::string piece;
    if (!has_begun_) piece = format_ == Format::csv ? kCsvHead : "{\"scans\":[";
    has_begun_ = true;
    // A page may be empty though others follow: an empty piece would end the answer.
    do {
      Store* const store = hub_.store();
      if (store == nullptr) return Failure{hub_.problem()};
      const Expected<HistoryPage> page =
          store->history().page(filter_, kScansAPiece, after_, HistoryOrder::oldest_first);
      if (!page.ok()) return Failure{page.failure()};
      for (const StoredScan& scan : page->scans) {
        const Expected<Json> json = scan_answer(*store, scan);
        if (!json.ok()) return Failure{json.failure()};
        piece += text_of(*json);
      }
      after_ = page->next;
      is_over_ = !after_;
    } while (piece.empty() && !is_over_);
    if (is_over_ && format_ == Format::json) piece += "]}";
    return piece;
  }

 private:
  std::string text_of(const Json& scan) {
    if (format_ == Format::csv) return csv_lines(scan);
    std::string text;
    if (std::exchange(has_written_, true)) text += ',';
    text += scan.dump(-1, ' ', false, Json::error_handler_t::replace);
    return text;
  }

  HubStore& hub_;
  HistoryFilter filter_;
  Format format_;
  std::optional<HistoryCursor> after_;
  bool has_begun_ = false;
  bool has_written_ = false;
  bool is_over_ = false;
};

HttpResponse answer_export(HubStore& hub, const HttpRequest& request, Format format) {
  if (hub.store() == nullptr) return store_failure(hub.problem());
  Expected<HistoryFilter> filter = parse_history_filter(request, {});
  if (!filter.ok()) return wrong_request(filter.failure());
  const auto source = std::make_shared<Export>(hub, std::move(*filter), format);
  HttpResponse response;
  response.content_type = format == Format::csv ? "text/csv; charset=utf-8" : "application/json";
  const std::string name = format == Format::csv ? "traygauge.csv" : "traygauge.json";
  response.headers.emplace_back("Content-Disposition", "attachment; filename=\"" + name + "\"");
  response.body = make_piece_stream([source] { return source->next(); });
  return response;
}

}  // namespace

void add_export_routes(Router& router, const HubSite& site) {
  HubStore& store = site.store;
  router.add({"GET", "/api/v1/export.csv", Role::view, 0,
              [&store](const HttpRequest& request) { return answer_export(store, request, Format::csv); }});
  router.add({"GET", "/api/v1/export.json", Role::view, 0,
              [&store](const HttpRequest& request) { return answer_export(store, request, Format::json); }});
}

}  // namespace traygauge
