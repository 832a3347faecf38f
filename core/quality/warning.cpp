#include "core/quality/warning.hpp"

namespace traygauge {
namespace {

struct WarningText {
  const char* name;
  const char* sentence;
};

#define TRAYGAUGE_TEXT(code, text) {#code, text},
constexpr std::array<WarningText, kWarningCount> kWarningTexts = {{TRAYGAUGE_WARNINGS(TRAYGAUGE_TEXT)}};
#undef TRAYGAUGE_TEXT

}  // namespace

const char* name(Warning warning) {
  return kWarningTexts[static_cast<std::size_t>(warning)].name;
}

const char* sentence(Warning warning) {
  return kWarningTexts[static_cast<std::size_t>(warning)].sentence;
}

}  // namespace traygauge
