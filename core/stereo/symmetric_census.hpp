// The centre-symmetric census transform (Spangenberg, Langner, Rojas 2013): each bit compares two pixels that
// lie opposite each other in a window of 9 × 7. Half the bits of the census of the same window for the same
// support, blind to brightness and contrast, and unlike it not wholly at the mercy of one noisy centre.
#pragma once

#include <cstdint>

#include "core/image_view/image_view.hpp"

namespace traygauge {

// To either side of the centre, as in the paper; of the window's pairs, each gives a bit.
inline constexpr int kSymmetricCensusColumns = 4;
inline constexpr int kSymmetricCensusRows = 3;
inline constexpr int kSymmetricCensusBits =
    ((2 * kSymmetricCensusColumns + 1) * (2 * kSymmetricCensusRows + 1) - 1) / 2;

// `codes` has the picture's size. Beyond the picture its border is repeated.
void transform_symmetric_census(ImageView<const std::uint8_t> picture, ImageView<std::uint32_t> codes);

// The bits whose pixels both carry the label of the window's centre: an outline tells how the surfaces on its
// two sides move only where both are the same surface. `masks` has the picture's size.
void mask_symmetric_census(ImageView<const std::uint8_t> labels, ImageView<std::uint32_t> masks);

}  // namespace traygauge
