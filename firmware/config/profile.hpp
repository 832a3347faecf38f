// The profiles that `--profile` names.
#pragma once

#include <string>

#include "core/pipeline/configuration.hpp"

namespace traygauge {

const char* name(Profile profile);

// The profile that is meant; `typed` may be empty: best. UsageError unless this program has it.
Profile choose_profile(const std::string& typed);

}  // namespace traygauge
