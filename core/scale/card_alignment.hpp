// Where a camera stands in the table frame, by aligning the card's known print with the picture's grey
// values: the pattern under a six-degree-of-freedom pose, Gauss-Newton from coarse to fine (Lucas & Kanade
// 1981; Baker & Matthews 2004, forward additive), gain and offset estimated with it.
#pragma once

#include <array>
#include <cstdint>

#include "core/base/geometry.hpp"
#include "core/base/status.hpp"
#include "core/base/table_frame.hpp"
#include "core/image/camera.hpp"
#include "core/scale/card_outline.hpp"
#include "core/scale/card_pattern.hpp"
#include "core/scale/card_picture.hpp"
#include "core/segmentation/label_regions.hpp"

namespace traygauge {

struct CardAlignmentParams {
  CardPatternParams pattern;
  CardOutlineParams outline;
  CardPictureParams picture;

  // Blur of the print in each stage, standard deviation in pixels of the picture. Half of it is the reach
  // within which edges still find each other.
  double coarse_blur_px = 2.5;
  double medium_blur_px = 1.2;
  // Sharper than a lens and its pixels make the picture, the fit follows aliases in it; the finest blur lies
  // above their usual 0.3 to 0.5 px. Up to `finest_blur_px · 2^1.5` are tried for pictures out of focus.
  double finest_blur_px = 0.6;
  double max_correlation_lag = 0.25;  // of a first pose behind the best, to be refined as well
  int coarse_iterations = 5;
  int medium_iterations = 4;
  int fine_iterations = 4;
  double cutoff_spreads = 6.0;   // of Geman and McClure's weights, in robust standard deviations
  double min_spread_gray = 1.0;  // below it residuals are rounding
  double max_step_px = 8.0;      // of a corner in one iteration: further, the linearisation means nothing
  double converged_px = 0.01;    // a corner's step that ends a stage
  int max_samples = 60'000;      // of the fine stage; more make the pose slower, no longer better

  double min_correlation = 0.5;    // of print and picture; wrong places stay below 0.3
  double min_visible_share = 0.5;  // of the card
  double min_tilt_cosine = 0.17;   // between the card's normal and the view: 80 degrees
  // What grey values do not show: error of a corner's place by lens, print and flatness, per axis and corner.
  double systematic_px = 0.02;
};

struct CardAlignment {
  Pose camera_from_table;
  // Of a step as in `moved`: inverse covariance, 1 / (rad, mm)². From the scatter of the residuals' gradients
  // (White 1980, clustered by tiles, so that noise which differs or hangs together is counted rightly) and
  // the systematic error.
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
  double correlation = 0.0;    // of print and picture, over the card's visible pixels
  double visible_share = 0.0;  // of the card, inside its label and the picture
  double rms_gray = 0.0;       // robust standard deviation of the residuals
  double gain = 0.0;           // picture's grey values over the print's
  double blur_px = 0.0;        // of the print, where it fits best
};

struct CardAlignmentWorkspace {
  CardOutlineWorkspace outline;
  CardPicture picture;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, const CardAlignmentParams& params) {
    outline.allocate(arena, params.outline);
    picture.allocate(arena, params.picture);
  }
};

// `gray` and `labels` as stored, of the lens's size; `box` is LabelRegions::card. The outline gives four ways
// to lay the print on it and two poses each (Schweighofer & Pinz 2006); grey values choose. card_not_found
// without a label, when less than half of the card is seen, or when nothing correlates.
Status align_card(ImageView<const std::uint8_t> gray, ImageView<const std::uint8_t> labels,
                  const PixelBox& box, const LensModel& lens, const CardPattern& pattern,
                  const CardAlignmentParams& params, CardAlignmentWorkspace& workspace,
                  CardAlignment& alignment);

}  // namespace traygauge
