#include "core/quality/warning.hpp"

namespace traygauge {
namespace {

#define TRAYGAUGE_TEXT(code, text) text,
constexpr std::array<const char*, kWarningCount> kWarningTexts = {TRAYGAUGE_WARNINGS(TRAYGAUGE_TEXT)};
#undef TRAYGAUGE_TEXT

}  // namespace

const char* name(Warning warning) {
  return kWarningNames[static_cast<std::size_t>(warning)];
}

const char* sentence(Warning warning) {
  return kWarningTexts[static_cast<std::size_t>(warning)];
}

}  // namespace traygauge
