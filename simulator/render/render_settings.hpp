// How much work a picture is worth.
#pragma once

#include <cstdint>

namespace traygauge {

struct RenderSettings {
  // Rays through a pixel's surroundings, 8 to 4096, rounded up to a multiple of 8. Fewer: noisy fine texture;
  // time grows with it.
  int samples = 8;
  // Likewise at edges where neighbouring pixels' rays differ much, if it is more. Fewer: jagged edges.
  int edge_samples = 16;
  // Half of the rays will do for a pixel, no edge, whose neighbours' rays differ by less than this share
  // (standard deviation), 0 to 1; three times that is much. More: noisy fine texture; 0: never half.
  float calm_spread = 0.05F;
  // Of each 8 rays, 1 to 8 gather light from other surfaces and the room. Fewer: noisier shade, smoothed by
  // the filter.
  int indirect_samples = 4;
  // Where some of a light is hidden, this many further shadow rays for each of the rays.
  int penumbra_samples = 3;
  // Light that was scattered up to this many times before it reaches what is seen, 1 to 8.
  int bounces = 2;
  // Light from other surfaces is smoothed over like surface within this many pixels; 0: not.
  float indirect_filter_px = 6.0F;
  int threads = 0;  // 0: as many as there are cores; the picture is the same for any
  std::uint64_t seed = 1;
  int view = 0;  // its number: views with one seed have different noise

  // Throws std::invalid_argument for a value out of range.
  void check() const;
};

}  // namespace traygauge
