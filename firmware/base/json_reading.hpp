// Reading JSON that others wrote. Templates, so that the library is defined only where documents are read.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace traygauge {

// The text under `key`; `otherwise` where there is none, or `json` is no object.
template <class Json>
std::string json_text(const Json& json, const char* key, const char* otherwise = "") {
  const auto found = json.find(key);
  return found != json.end() && found->is_string() ? found->template get<std::string>()
                                                   : std::string(otherwise);
}

// Discarded where it is no JSON, or nested deeper: the parser would follow it as deep as it is.
template <class Json = nlohmann::json>
Json parse_shallow_json(std::string_view text, int max_depth) {
  const auto is_shallow = [max_depth](int depth, typename Json::parse_event_t /*event*/, Json& /*parsed*/) {
    return depth <= max_depth;
  };
  return Json::parse(text, is_shallow, false);
}

}  // namespace traygauge
