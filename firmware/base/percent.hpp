// Shares are told in per cent.
#pragma once

namespace traygauge {

inline constexpr double kPercent = 100.0;

}  // namespace traygauge
