#include "core/base/status.hpp"

namespace traygauge {
namespace {

#define TRAYGAUGE_TEXT(code, text) text,
constexpr std::array<const char*, kStatusCodeCount> kStatusTexts = {TRAYGAUGE_STATUS_CODES(TRAYGAUGE_TEXT)};
#undef TRAYGAUGE_TEXT

}  // namespace

const char* name(StatusCode code) {
  return kStatusNames[static_cast<std::size_t>(code)];
}

const char* sentence(StatusCode code) {
  return kStatusTexts[static_cast<std::size_t>(code)];
}

}  // namespace traygauge
