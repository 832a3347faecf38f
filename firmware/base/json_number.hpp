// Numbers in JSON documents.
#pragma once

#include <nlohmann/json.hpp>

namespace traygauge {

// What was not measured is null, and so is what is not finite.
inline nlohmann::ordered_json number_or_null(double number, bool measured) {
  return measured ? nlohmann::ordered_json(number) : nlohmann::ordered_json(nullptr);
}

}  // namespace traygauge
