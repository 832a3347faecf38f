// Grey pictures from frames, and every change of scale. Pixel centres lie at integers.
#pragma once

#include <cstdint>

#include "core/geometry/camera.hpp"
#include "core/image_view/image_view.hpp"

namespace traygauge {

// The only place where a coordinate changes scale: x' = s (x + 0.5) − 0.5.
constexpr double scale_coordinate(double x, double scale) {
  return scale * (x + 0.5) - 0.5;
}

// Grey by the weights of ITU-R BT.601 in integers, as OpenCV's cvtColor. Equal sizes.
void convert_to_gray(const FrameView& frame, ImageView<std::uint8_t> gray);

// Averages the area that each pixel of the target covers exactly, rounded, halves upward: what OpenCV's
// INTER_AREA does where it shrinks. Any factor, targets up to 65535 pixels high.
void reduce_area(ImageView<const std::uint8_t> source, ImageView<std::uint8_t> target);

// The same in colours: `rgb` has three bytes a pixel, red, green, blue. Grey frames fill all three.
void reduce_colours(const FrameView& frame, ImageView<std::uint8_t> rgb);

// Enlarges by bilinear interpolation (any factor ≥ 1 in each direction, targets up to 4096 pixels wide and
// high), within 1 of OpenCV's INTER_LINEAR.
void enlarge_linear(ImageView<const std::uint8_t> source, ImageView<std::uint8_t> target);

// An undistorted, scaled cut-out of a frame.
struct Roi {
  PinholeCamera camera;  // of the cut-out
  int width = 0;
  int height = 0;
};

// 16 samples, with weights of 2^16 and grey values of 2^8: their sums fit 32 bits.
inline constexpr int kMaxSamplesAcross = 4;

struct ResampleParams {
  // Samples per target pixel and axis at most. Their number is the reduction, rounded; with fewer
  // the picture aliases, with more it only takes longer.
  int max_samples_per_axis = kMaxSamplesAcross;
};

// Samples `frame` (size of the lens) through the lens into `gray` (size of the cut-out): bilinear, averaged
// over a sub-grid that matches the reduction so that nothing aliases. Pixels whose centre lies outside the
// frame become 0.
void resample_undistorted(const FrameView& frame, const LensModel& lens, const Roi& cutout,
                          ImageView<std::uint8_t> gray, const ResampleParams& params = {});

// The same for labels, by nearest neighbour only.
void resample_labels_undistorted(ImageView<const std::uint8_t> labels, const LensModel& lens,
                                 const Roi& cutout, ImageView<std::uint8_t> target);

}  // namespace traygauge
