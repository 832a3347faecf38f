// How blurred a picture is, by the edges of the reference card's print, which are sharp: defocus and motion
// widen them, noise and lack of contrast do not.
#pragma once

#include <cstdint>

#include "core/image_view/image_view.hpp"

namespace traygauge {

// Of the profile across an edge, to each side: ends of edges up to 4 px wide.
inline constexpr int kEdgeReach_px = 8;

struct EdgeBlurParams {
  int border_px = kEdgeReach_px / 2;  // edges so near the region's border may be the border itself
  double min_rise_fraction = 0.45;    // of the region's contrast: weaker edges may be halftones of the print
  // Of the widths of the edges, in each direction: neighbouring print widens edges, nothing narrows them.
  double width_quantile = 0.25;
  int min_edges = 30;     // of a direction; fewer say nothing; a card 140 px long has a hundred
  int min_contrast = 16;  // grey values between dark and bright print; less is no print
};

struct EdgeBlur {
  bool is_measured = false;
  // Standard deviation of the Gaussian that makes edges as wide, in the direction in which they are widest.
  // A sharp picture has 0.8 to 0.95: pixels, demosaicing and compression.
  double sigma_px = 0.0;
  int dark = 0;    // second percentile of the region's grey values
  int bright = 0;  // 98th percentile: the print's white
};

// Over the pixels whose label is `label`. Where too few edges are found, is_measured is false.
EdgeBlur measure_edge_blur(ImageView<const std::uint8_t> gray, ImageView<const std::uint8_t> labels,
                           std::uint8_t label, const EdgeBlurParams& params);

}  // namespace traygauge
