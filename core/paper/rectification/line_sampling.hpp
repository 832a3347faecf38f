// Samples a picture along straight lines: the inner loops of rectification.
#pragma once

#include <cstdint>
#include <span>

#include "core/image_view/image_view.hpp"
#include "core/paper/rectification/epipolar_view.hpp"

namespace traygauge::paper {

// target[column] = source at line.pixel(column), bilinear on 1/256 of a pixel in integers; 0 outside.
void sample_line_bilinear(ImageView<const std::uint8_t> source, const RectifiedLine& line,
                          std::span<std::uint8_t> target);

// The same by nearest neighbour, for labels.
void sample_line_nearest(ImageView<const std::uint8_t> source, const RectifiedLine& line,
                         std::span<std::uint8_t> target);

}  // namespace traygauge::paper
