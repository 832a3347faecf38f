// What a worse camera does to pictures that are there already.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>

#include "simulator/capture/capture.hpp"

namespace traygauge::tables {

struct PictureChange {
  double noise_grey = 0.0;  // standard deviation of noise in grey values, alike in all colours of a pixel
  bool local_tone = false;  // contrast evened out over parts of the picture, as phones do; before the noise

  bool is_none() const { return noise_grey == 0.0 && !local_tone; }
};

std::string describe(const PictureChange& change);

// The same seed gives the same noise.
void change_picture(const PictureChange& change, std::uint64_t seed, Picture& picture);

// `capture` with the views of one pair changed; they lie in `folder`. A picture's bytes are its seed: copies
// of a capture get the same noise. Throws InputError, OutputError.
Capture change_views(Capture capture, const std::array<int, 2>& pair, const PictureChange& change,
                     const std::filesystem::path& folder);

}  // namespace traygauge::tables
