// The profiles that `--profile` names.
#pragma once

#include <string>

namespace traygauge {

// The profile that is meant; `typed` may be empty: the default. UsageError unless this program has it.
std::string choose_profile(const std::string& typed);

}  // namespace traygauge
