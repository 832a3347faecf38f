// The values of a scan that say how a station keeps: a number a scan for each.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace traygauge {

enum class WatchedCheck : std::uint8_t {
  scale_percent,    // by how much the card makes everything too large
  dish_height_mm,   // how far the edges of dishes lie over where card and description put them
  glaze_height_mm,  // how far bare glaze inside of dishes lies over where their descriptions put it
  blur_px,          // how blurred the pictures are
};
inline constexpr auto kWatchedCheckNames =
    std::to_array<const char*>({"scale_percent", "dish_height_mm", "glaze_height_mm", "blur_px"});
inline constexpr std::size_t kWatchedChecks = kWatchedCheckNames.size();
inline const char* name(WatchedCheck check) {
  return kWatchedCheckNames[static_cast<std::size_t>(check)];
}

// By WatchedCheck; none where the scan does not say.
using CheckValues = std::array<std::optional<double>, kWatchedChecks>;

// Of a scan's document: the median over its dishes, and over both pictures. What is absent, of another kind
// or no possible measurement says nothing.
CheckValues read_check_values(std::string_view document);

}  // namespace traygauge
