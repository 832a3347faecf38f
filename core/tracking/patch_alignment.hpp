// A patch of the first view aligned with the second to a fraction of a pixel: Lucas and Kanade's method in
// its inverse compositional form (Baker and Matthews 2004), with gain and offset of the grey values.
#pragma once

#include <cstdint>

#include "core/geometry/geometry.hpp"
#include "core/image_view/image_view.hpp"
#include "core/tracking/alignment_equations.hpp"

namespace traygauge {

// Half or twice of any number here moves the MAPE of six pairs of the captures by 0.07 points at most
// (tests/evaluation/numbers.tsv).
struct PatchAlignmentParams {
  // Steps of the shift alone, 3 to 5 are usual; and steps of the whole map, each of which samples the patch
  // anew.
  int max_shifts = 8;
  int max_affine_steps = 3;
  // A smaller step is the last.
  double converged_px = 0.02;
  // From the start: farther away, something else was found.
  double max_shift_px = 3.0;
  // Of any element of the map: a surface that steep is hidden in one of the views.
  double max_affine_change = 0.3;
  // Prior of the change per element (slopes of 45° seen 15° apart give 0.2), and the grey values' noise that
  // weighs it, also the least that a residual is taken for.
  double affine_sigma = 0.2;
  double grey_sigma = 0.5;
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
