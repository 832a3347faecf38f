// What faults make of a picture on its way into memory.
#pragma once

#include <cstdint>
#include <span>

#include "core/image_view/image_view.hpp"

namespace traygauge {

// The first `rows` rows and `columns` pixels of `source` as a picture of their own in `buffer`.
FrameView copy_part(const FrameView& source, int columns, int rows, std::span<std::uint8_t> buffer);
FrameView copy_frame(const FrameView& source, std::span<std::uint8_t> buffer);

// The last `share` of the rows are those of `other`, which has the same size; the first when it is negative.
FrameView mix_frames(const FrameView& source, const FrameView& other, double share,
                     std::span<std::uint8_t> buffer);

// Noise of the size of `source`; the same seed, the same noise.
FrameView fill_with_noise(const FrameView& source, std::uint64_t seed, std::span<std::uint8_t> buffer);

}  // namespace traygauge
