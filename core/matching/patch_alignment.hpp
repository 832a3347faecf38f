// A patch of the first view aligned with the second to a fraction of a pixel: Lucas and Kanade's method in
// its inverse compositional form (Baker and Matthews 2004), with gain and offset of the grey values.
#pragma once

#include <cstdint>

#include "core/base/geometry.hpp"
#include "core/image_view/image_view.hpp"

namespace traygauge {

inline constexpr int kAlignmentSide = 16;  // of the patch, in pixels of the second picture

enum class PatchMotion : std::uint8_t {
  shift,   // the affine map is known: a plane in known attitude
  affine,  // it is refined as well
};

struct PatchAlignmentParams {
  int max_shifts = 8;              // steps of the shift alone: 3 to 5 are usual
  int max_affine_steps = 3;        // each samples the patch anew
  double converged_px = 0.02;      // a step below ends: the next would be smaller than its square
  double max_shift_px = 3.0;       // from the start: farther, another thing was found
  double max_affine_change = 0.3;  // of any element: a surface that steep is hidden in one of the views
  double affine_sigma = 0.2;       // prior of the change per element: slopes of 45° seen 15° apart give 0.2
  double grey_sigma = 2.0;  // grey values: noise assumed in the prior's weight and at least in sigma_px
};

struct PatchAlignment {
  Vec2 pixel = Vec2::Zero();  // in the second picture; on input the start
  Eigen::Matrix2d first_from_second = Eigen::Matrix2d::Identity();
  double correlation = 0.0;    // of the patches as aligned
  double residual_grey = 0.0;  // standard deviation of what gain, offset and motion leave
  double sigma_px = 0.0;       // of the place per axis: the residual through the patch's structure tensor
};

// False when the patch leaves a picture, has no structure in some direction, or drifts beyond the limits.
bool align_patch(ImageView<const std::uint8_t> first, const Vec2& first_pixel,
                 ImageView<const std::uint8_t> second, PatchMotion motion, const PatchAlignmentParams& params,
                 PatchAlignment& alignment);

}  // namespace traygauge
