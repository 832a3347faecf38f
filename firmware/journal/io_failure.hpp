// Sentences for what a disk refuses.
#pragma once

#include <string>
#include <string_view>
#include <system_error>

#include "firmware/base/expected.hpp"

namespace traygauge {

// "PATH: WHAT: No space left on device. Free space on this disk."
Failure io_failure(std::string_view path, std::string_view what, std::error_code error);

// What to do about it; empty where nothing general helps.
std::string_view io_advice(std::error_code error);

}  // namespace traygauge
