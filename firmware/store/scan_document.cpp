#include "firmware/store/scan_document.hpp"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "firmware/base/wall_clock.hpp"

namespace traygauge {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kMaxDepth = 32;
constexpr std::size_t kMaxItems = 255;  // labels are a byte
constexpr int kMaxLabel = 255;

// Of brackets outside texts; comparing documents recurs by as much.
std::size_t depth_of(std::string_view text) {
  std::size_t depth = 0;
  std::size_t deepest = 0;
  bool is_in_text = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char character = text[i];
    if (is_in_text) {
      if (character == '\\') ++i;
      if (character == '"') is_in_text = false;
    } else if (character == '"') {
      is_in_text = true;
    } else if (character == '[' || character == '{') {
      deepest = std::max(deepest, ++depth);
    } else if ((character == ']' || character == '}') && depth > 0) {
      --depth;
    }
  }
  return deepest;
}

// Discarded where the text is no JSON, or too large to be a scan's.
Json parse(std::string_view text) {
  const bool may_be_one = text.size() <= kMaxScanDocumentBytes && depth_of(text) <= kMaxDepth;
  return Json::parse(may_be_one ? text : std::string_view(), nullptr, false);
}

// Reads keys of one object and remembers the first that is not as expected.
class Reader {
 public:
  Reader(const Json& object, std::string path, std::string& problem)
      : object_(object), path_(std::move(path)), problem_(problem) {}

  std::string text(const char* key) {
    const Json* const value = find(key);
    if (value != nullptr && value->is_string()) return value->get<std::string>();
    refuse(key, "text", value);
    return {};
  }
  // Empty where it is null or absent.
  std::string optional_text(const char* key) {
    const Json* const value = find(key);
    return value == nullptr || value->is_null() ? std::string() : text(key);
  }
  std::optional<double> optional_number(const char* key) {
    const Json* const value = find(key);
    if (value == nullptr || value->is_null()) return std::nullopt;
    if (value->is_number()) return value->get<double>();
    refuse(key, "a number or null", value);
    return std::nullopt;
  }
  bool boolean(const char* key) {
    const Json* const value = find(key);
    if (value != nullptr && value->is_boolean()) return value->get<bool>();
    refuse(key, "true or false", value);
    return false;
  }
  std::uint64_t count(const char* key, std::uint64_t max) {
    const Json* const value = find(key);
    if (value != nullptr && value->is_number_unsigned() && value->get<std::uint64_t>() <= max) {
      return value->get<std::uint64_t>();
    }
    refuse(key, "a whole number from 0 to " + std::to_string(max), value);
    return 0;
  }
  const Json* list(const char* key) {
    const Json* const value = find(key);
    if (value != nullptr && value->is_array()) return value;
    refuse(key, "a list", value);
    return nullptr;
  }
  void refuse(const char* key, const std::string& expected, const Json* found) {
    if (!problem_.empty()) return;
    constexpr std::size_t kMaxShown = 60;
    std::string shown =
        found == nullptr ? "nothing" : found->dump(-1, ' ', true, Json::error_handler_t::replace);
    if (shown.size() > kMaxShown) shown = shown.substr(0, kMaxShown) + "...";
    problem_ = "key " + path_ + key + ": expected " + expected + ", found " + shown;
  }
  const Json* find(const char* key) const {
    const auto found = object_.find(key);
    return found == object_.end() ? nullptr : &*found;
  }

 private:
  const Json& object_;
  std::string path_;
  std::string& problem_;
};

MeasuredItem read_item(Reader& item) {
  MeasuredItem read;
  read.label = static_cast<int>(item.count("label", kMaxLabel));
  read.dish = static_cast<int>(item.count("dish", kMaxLabel));
  read.status = item.text("status");
  read.volume_ml = item.optional_number("volume_ml");
  read.sigma_ml = item.optional_number("sigma_ml");
  read.food = item.optional_text("food");
  return read;
}

std::vector<MeasuredItem> read_items(Reader& scan, std::string& problem) {
  const Json* const list = scan.list("items");
  std::vector<MeasuredItem> items;
  if (list == nullptr) return items;
  if (list->size() > kMaxItems) scan.refuse("items", "at most 255 items", list);
  for (std::size_t i = 0; i < list->size() && problem.empty(); ++i) {
    const std::string path = "items[" + std::to_string(i) + "].";
    if (!(*list)[i].is_object()) {
      scan.refuse("items", "a list of objects", list);
      break;
    }
    Reader item((*list)[i], path, problem);
    items.push_back(read_item(item));
    const auto is_twin = [&](const MeasuredItem& other) { return other.label == items.back().label; };
    if (std::any_of(items.begin(), items.end() - 1, is_twin)) {
      item.refuse("label", "a label that no other item has", item.find("label"));
    }
  }
  return items;
}

ScanId read_id(Reader& scan) {
  const std::string text = scan.text("id");
  const std::optional<ScanId> id = parse_scan_id(text);
  const Json* const found = scan.find("id");
  if (!id) {
    scan.refuse("id", "a scan's id such as \"kitchen-17\"", found);
    return {};
  }
  if (scan.text("station") != id->station) {
    scan.refuse("station", "the station of " + text, scan.find("station"));
  }
  if (scan.count("number", std::numeric_limits<std::uint64_t>::max()) != id->number) {
    scan.refuse("number", "the number of " + text, scan.find("number"));
  }
  return *id;
}

std::optional<ScanId> read_superseded(Reader& scan, const ScanId& own) {
  const Json* const found = scan.find("supersedes");
  if (found == nullptr || found->is_null()) return std::nullopt;
  const std::string text = scan.text("supersedes");
  std::optional<ScanId> id = parse_scan_id(text);
  if (!id || id->station != own.station || id->number >= own.number) {
    scan.refuse("supersedes", "an earlier scan of the same station, or null", found);
  }
  return id;
}

std::int64_t read_time(Reader& scan) {
  const std::optional<std::int64_t> taken_ms = parse_utc(scan.text("taken_at"));
  if (!taken_ms) {
    scan.refuse("taken_at", "a time such as \"2026-11-27T07:40:12.345Z\"", scan.find("taken_at"));
  }
  return taken_ms.value_or(0);
}

}  // namespace

Expected<ScanDocument> read_scan_document(std::string_view text) {
  const Json json = parse(text);
  if (!json.is_object()) {
    return Failure{"the document is no JSON object of at most " + std::to_string(kMaxScanDocumentBytes) +
                   " bytes and " + std::to_string(kMaxDepth) + " levels"};
  }
  std::string problem;
  Reader scan(json, "", problem);
  if (scan.count("version", std::numeric_limits<int>::max()) != kScanDocumentVersion) {
    scan.refuse("version", std::to_string(kScanDocumentVersion), scan.find("version"));
  }
  ScanDocument read;
  read.id = read_id(scan);
  read.taken_ms = read_time(scan);
  read.clock_synchronised = scan.boolean("clock_synchronised");
  read.supersedes = read_superseded(scan, read.id);
  read.tray = scan.optional_text("tray");
  read.status = scan.text("status");
  read.message = scan.text("message");
  read.items = read_items(scan, problem);
  if (!problem.empty()) return Failure{problem};
  return read;
}

bool is_same_document(std::string_view one, std::string_view other) {
  if (one == other) return true;
  const Json first = parse(one);
  return !first.is_discarded() && first == parse(other);
}

bool is_plain_text(std::string_view text, std::size_t max_bytes) {
  if (text.size() > max_bytes) return false;
  // The parser refuses control characters and what is no UTF-8.
  std::string quoted(1, '"');
  for (const char character : text) quoted += character == '"' || character == '\\' ? '-' : character;
  quoted += '"';
  return text.find('\x7f') == std::string_view::npos && Json::accept(quoted);
}

}  // namespace traygauge
