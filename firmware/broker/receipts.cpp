#include "firmware/broker/receipts.hpp"

#include <nlohmann/json.hpp>

#include "firmware/base/json_reading.hpp"

namespace traygauge {
namespace {

using Json = nlohmann::json;

std::string dump(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string make_receipt(std::span<const std::string>& ids) {
  std::string text = R"({"ids":[)";
  std::size_t count = 0;
  for (const std::string& id : ids) {
    const std::string quoted = dump(id);
    // The closing brackets and a comma.
    if (count > 0 && text.size() + quoted.size() + 3 > kMaxReceiptBytes) break;
    if (count > 0) text += ',';
    text += quoted;
    ++count;
  }
  ids = ids.subspan(count);
  return text + "]}";
}

std::optional<std::vector<std::string>> parse_receipt(const std::string& payload) {
  if (payload.size() > kMaxReceiptBytes) return std::nullopt;
  constexpr int kMaxDepth = 2;
  const Json json = parse_shallow_json(payload, kMaxDepth);
  if (!json.is_object() || !json.contains("ids") || !json["ids"].is_array()) return std::nullopt;
  std::vector<std::string> ids;
  for (const Json& id : json["ids"]) {
    if (!id.is_string()) return std::nullopt;
    ids.push_back(id.get<std::string>());
  }
  return ids;
}

}  // namespace traygauge
