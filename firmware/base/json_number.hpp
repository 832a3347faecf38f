// Numbers in JSON documents.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace traygauge {

// What was not measured is null, and so is what is not finite. A template, so that the library is defined
// only where documents are composed.
template <class Json = nlohmann::ordered_json>
Json number_or_null(double number, bool measured) {
  return measured ? Json(number) : Json(nullptr);
}

}  // namespace traygauge
