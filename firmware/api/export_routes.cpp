#include <array>
#include <nlohmann/json.hpp>
#include <span>

#include "firmware/api/history_query.hpp"
#include "firmware/api/hub_site.hpp"
#include "firmware/api/scan_answer.hpp"
#include "firmware/base/csv_fields.hpp"

namespace traygauge {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kScansAPiece = 16;  // some 10 kB, and 2 ms of the hub's time

// A column and the key of the answer that it shows.
struct Column {
  const char* name;
  const char* key;
};
constexpr auto kScanColumns = std::to_array<Column>({{"id", "id"},
                                                     {"station", "station"},
                                                     {"number", "number"},
                                                     {"taken_at", "taken_at"},
                                                     {"taken_at_local", "taken_at_local"},
                                                     {"clock_synchronised", "clock_synchronised"},
                                                     {"received_at", "received_at"},
                                                     {"tray", "tray"},
                                                     {"status", "status"},
                                                     {"supersedes", "supersedes"},
                                                     {"superseded_by", "superseded_by"},
                                                     {"scan_wrong", "is_wrong"}});
constexpr auto kItemColumns = std::to_array<Column>({{"item", "label"},
                                                     {"dish", "dish"},
                                                     {"item_status", "status"},
                                                     {"food", "food"},
                                                     {"volume_ml", "volume_ml"},
                                                     {"sigma_ml", "sigma_ml"},
                                                     {"item_wrong", "is_wrong"},
                                                     {"measured_food", "measured_food"},
                                                     {"measured_volume_ml", "measured_volume_ml"}});

// A table calculation takes a cell that begins so for a formula.
std::string csv_text(const std::string& text) {
  const bool looks_like_formula =
      !text.empty() && std::string_view("=+-@\t\r").find(text.front()) != std::string_view::npos;
  return csv_field(looks_like_formula ? std::string("'").append(text) : text);
}

std::string csv_value(const Json& value) {
  if (value.is_null()) return {};
  if (value.is_string()) return csv_text(value.get<std::string>());
  if (value.is_number_float()) return csv_number(value.get<double>(), 1);
  return value.dump();
}

// `value_of` gives a column's text.
template <class ValueOf>
std::string csv_cells(std::span<const Column> columns, ValueOf value_of) {
  std::string text;
  for (const Column& column : columns) {
    if (&column != columns.data()) text += ',';
    text += value_of(column);
  }
  return text;
}

std::string csv_head() {
  const auto name = [](const Column& column) { return std::string(column.name); };
  return csv_cells(kScanColumns, name) + ',' + csv_cells(kItemColumns, name) + "\r\n";
}

// A line for each item; a scan without items has one, too, so that no refusal is hidden.
std::string csv_lines(const Json& scan) {
  const auto value_in = [](const Json& json) {
    return [&json](const Column& column) { return csv_value(json[column.key]); };
  };
  const std::string head = csv_cells(kScanColumns, value_in(scan)) + ',';
  if (scan["items"].empty())
    return head + csv_cells(kItemColumns, [](const Column&) { return std::string(); }) + "\r\n";
  std::string lines;
  for (const Json& item : scan["items"]) lines += head + csv_cells(kItemColumns, value_in(item)) + "\r\n";
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
    if (!has_begun_) piece = format_ == Format::csv ? csv_head() : "{\"scans\":[";
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
