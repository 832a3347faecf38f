// What openapi.yaml holds.
#pragma once

#include <string_view>

namespace traygauge {

std::string_view description_text();

}  // namespace traygauge
