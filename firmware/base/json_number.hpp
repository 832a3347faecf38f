// Values in JSON documents that may be missing.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>

namespace traygauge {

// What was not measured is null, and so is what is not finite. A template, so that the library is defined
// only where documents are composed.
template <class Json = nlohmann::ordered_json>
Json number_or_null(double number, bool measured) {
  return measured ? Json(number) : Json(nullptr);
}

template <class Json = nlohmann::ordered_json, class Value>
Json value_or_null(const std::optional<Value>& value) {
  return value ? Json(*value) : Json(nullptr);
}

}  // namespace traygauge
