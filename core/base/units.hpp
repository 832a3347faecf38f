// Units of what is reported, in those of the geometry (mm).
#pragma once

namespace traygauge {

inline constexpr double kMm3PerMl = 1000.0;

}  // namespace traygauge
