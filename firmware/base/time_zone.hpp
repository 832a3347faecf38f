// The site's time zone: the one in which people there read times.
#pragma once

#include <cstdint>
#include <string>

#include "firmware/base/expected.hpp"

namespace traygauge {

// Names as the system's zone files have them, such as "Europe/Berlin". From then on the whole process has
// that zone; called before threads start. Fails where there is no such file.
Expected<void> set_time_zone(const std::string& name);

// The zone of this machine, where nobody set another; empty where it has no name.
std::string machine_time_zone();

// "2026-11-27T08:40:12.345+01:00", in the process's zone; of the years 1970 to 9999.
std::string local_text(std::int64_t unix_ms);

}  // namespace traygauge
