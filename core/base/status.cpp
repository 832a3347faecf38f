#include "core/base/status.hpp"

#include <array>

namespace traygauge {
namespace {

struct StatusText {
  const char* name;
  const char* sentence;
};

#define TRAYGAUGE_TEXT(code, text) {#code, text},
constexpr std::array<StatusText, kStatusCodeCount> kStatusTexts = {{TRAYGAUGE_STATUS_CODES(TRAYGAUGE_TEXT)}};
#undef TRAYGAUGE_TEXT

}  // namespace

const char* name(StatusCode code) {
  return kStatusTexts[static_cast<std::size_t>(code)].name;
}

const char* sentence(StatusCode code) {
  return kStatusTexts[static_cast<std::size_t>(code)].sentence;
}

}  // namespace traygauge
