// Corners of a picture, and those of the card's print that they look like.
#pragma once

#include <cstdint>
#include <span>

#include "core/card/card_search.hpp"
#include "core/features/corners.hpp"
#include "core/image_view/image_view.hpp"

namespace traygauge {

// Shrinks or enlarges `source` into `storage`.
ImageView<std::uint8_t> resize_into(ImageView<const std::uint8_t> source, double scale,
                                    std::span<std::uint8_t> storage);

// Of a picture that lies in the storage of `compared`; clears the matches.
void find_compared_corners(ImageView<const std::uint8_t> picture, const CardSearchParams& params,
                           CornerWorkspace& workspace, ComparedCorners& compared);

// Adds a match for each of these corners that looks like one place of the print alone.
void match_corners(std::span<const Corner> corners, const PrintCorners& print, const CardSearchParams& params,
                   ComparedCorners& compared);

}  // namespace traygauge
