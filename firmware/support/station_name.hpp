// A station's name in the text of its file.
#pragma once

#include <string>

#include "firmware/base/expected.hpp"

namespace traygauge {

// `text` with another name in the line `name = "…"` of [station], and nothing else changed. Fails where the
// text has no such line.
Expected<std::string> with_station_name(const std::string& text, const std::string& name);

}  // namespace traygauge
