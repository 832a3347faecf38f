// The mean colour of every labelled region: how light and white balance differ between two views.
#pragma once

#include <array>
#include <cstdint>

#include "core/base/units.hpp"
#include "core/image_view/image_view.hpp"

namespace traygauge {

// Linear light, 0…1; the three are equal in a grey frame.
struct RegionColour {
  std::uint32_t samples = 0;
  float red = 0.0F;
  float green = 0.0F;
  float blue = 0.0F;
};

using RegionColours = std::array<RegionColour, kByteValues>;  // by label; the background's is not measured

struct RegionColourParams {
  int step_px = 2;  // every so many pixels, in both directions, are looked at
  int min_samples =
      100;  // fewer in either view: the region is not compared; their mean has a tenth of the scatter
};

void measure_region_colours(const FrameView& frame, ImageView<const std::uint8_t> labels,
                            const RegionColourParams& params, RegionColours& colours);

// Medians over the regions that both views show: a shiny soup does not decide. Each at least 1, whichever
// view has more; 1 without common regions.
struct ColourDifference {
  double exposure_ratio = 1.0;       // of light; 2 is one stop
  double white_balance_ratio = 1.0;  // of red to green or blue to green, whichever differs more
};

ColourDifference compare_colours(const RegionColours& first, const RegionColours& second,
                                 const RegionColourParams& params);

}  // namespace traygauge
