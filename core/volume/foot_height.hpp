// How high an item lies over its dish where its picture ends against the dish's. Food lies on its dish: what
// comes out below it did not stay where it was between the pictures, or the dish is another one.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/dish/dish_profile.hpp"
#include "core/stereo/surface_grid.hpp"

namespace traygauge {

// The lower quartile over samples of `item`, matched from both views, within three samples of kDishLabel;
// the lower one of both views, in mm over the dish's inner surface. Nothing where fewer than 30 samples tell
// it.
std::optional<double> foot_height_mm(const std::array<SurfaceGrid, 2>& views, const InnerSurface& inner,
                                     std::uint8_t item);

}  // namespace traygauge
