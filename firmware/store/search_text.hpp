// Text that is found whatever its case.
#pragma once

#include <string>
#include <string_view>

namespace traygauge {

// Lower case of ASCII and of the Latin letters up to U+00DE, which English and German need; other bytes stay.
std::string fold_case(std::string_view text);

}  // namespace traygauge
