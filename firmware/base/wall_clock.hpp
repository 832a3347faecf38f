// The time of day, and whether it can be trusted: a board without a battery starts in the past.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace traygauge {

struct WallTime {
  std::int64_t unix_ms = 0;   // UTC, since 1970-01-01
  bool synchronised = false;  // the kernel says that something disciplines this clock

  friend bool operator==(const WallTime&, const WallTime&) = default;
};

WallTime read_wall_clock();

// The last time that texts of ours have room for.
inline constexpr std::int64_t kEndOf9999Ms = 253'402'300'799'999;

// "2026-11-27T07:40:12.345Z", of the years 1970 to 9999; times outside are clamped to them.
std::string utc_text(std::int64_t unix_ms);
// Reads utc_text() back, with or without fractions of a second; none where the text is no such time.
std::optional<std::int64_t> parse_utc(std::string_view text);

}  // namespace traygauge
