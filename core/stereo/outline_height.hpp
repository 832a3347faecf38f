// How high food reaches, by its outlines alone: where smooth food has hardly a corner, nothing else tells
// that before it is matched.
#pragma once

#include <array>
#include <cstdint>

#include "core/image_view/image_view.hpp"
#include "core/stereo/plane_rectification.hpp"

namespace traygauge {

// mm over the rectified plane, of the tallest item; 0 without one that both views see the sides of. `labels`
// are of the grid, by view. Between an item's sides, where lines of sight pass it, lies its middle: a body
// that rests on the dish reaches twice as high.
double height_by_outlines_mm(const PlaneRectification& grid,
                             const std::array<ImageView<const std::uint8_t>, 2>& labels);

}  // namespace traygauge
