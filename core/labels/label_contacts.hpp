// What the pixels of one label touch.
#pragma once

#include <cstdint>
#include <span>

#include "core/base/units.hpp"
#include "core/image_view/image_view.hpp"

namespace traygauge {

// Adds to `contacts`, for each other label, how many sides of pixels it shares with `label`.
void count_contacts(ImageView<const std::uint8_t> labels, std::uint8_t label,
                    std::span<std::uint32_t, kByteValues> contacts);

}  // namespace traygauge
