// How high a liquid stands, by where its outline lies on the dish's wall: needs no texture.
#pragma once

#include <cstdint>
#include <span>

#include "core/dish/dish_profile.hpp"
#include "core/stereo/surface_grid.hpp"

namespace traygauge {

struct ContactLevel {
  double level_mm = 0.0;  // above the table
  double share = 0.0;     // of the outline with the dish that lies within the tolerance of it
  int samples = 0;        // of that outline, in both views
};

// The height of the dish at which most of the outline between item `label` and the dish lies, in both views:
// what a view sees past the near wall is higher, and stays out. `histogram` is scratch, by
// kContactBinMm from the dish's bottom up. share 0 without an outline.
inline constexpr double kContactBinMm = 0.125;
ContactLevel find_contact_level(std::span<const SurfaceGrid> views, const InnerSurface& dish,
                                std::uint8_t label, double tolerance_mm, std::span<std::uint32_t> histogram);

}  // namespace traygauge
