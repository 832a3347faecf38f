// Does a picture show colours? Found outlines need them.
#pragma once

#include "core/image_view/image_view.hpp"

namespace traygauge {

struct PictureColourParams {
  int step_px = 4;    // every so many pixels, in both directions, are looked at
  int min_apart = 8;  // grey values between a pixel's largest and smallest channel; less is noise of the file
  // Of the pixels. Photographs of trays have 0.64 and more, of fruit on a black and white board 0.13, a grey
  // body on white glaze and a grey table 0.85; the captures 0.54, and 0.03 at most with a twentieth of their
  // colours.
  double min_coloured_fraction = 0.05;
};

// False where the frame is empty, of one channel, or grey but for a few pixels.
bool shows_colour(const FrameView& frame, const PictureColourParams& params);

}  // namespace traygauge
