// Does a picture show colours? Found outlines need them.
#pragma once

#include "core/image_view/image_view.hpp"

namespace traygauge {

struct PictureColourParams {
  int step_px = 4;     // every so many pixels, in both directions, are looked at
  int min_apart = 16;  // grey values between a pixel's largest and smallest channel; less is noise and light
  // Of the pixels. 365 photographs of trays have 0.38 and more, the captures 0.36, fruit on a black and white
  // board 0.10; the captures with a tenth of their colour at most 0.008.
  double min_coloured_fraction = 0.05;
};

// False where the frame is empty, of one channel, or grey but for a few pixels.
bool shows_colour(const FrameView& frame, const PictureColourParams& params);

}  // namespace traygauge
