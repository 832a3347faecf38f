// Where a camera stands in the table frame, by aligning the card's known print with the picture's grey
// values: the pattern under a pose of six degrees of freedom, Gauss-Newton from coarse to fine (Lucas &
// Kanade 1981; Baker & Matthews 2004, forward additive), gain and offset estimated with it.
#pragma once

#include <cstdint>

#include "core/base/result.hpp"
#include "core/card/card_condition.hpp"
#include "core/card/card_outline.hpp"
#include "core/card/card_pattern.hpp"
#include "core/card/card_picture.hpp"
#include "core/card/card_refinement.hpp"
#include "core/geometry/camera.hpp"
#include "core/geometry/geometry.hpp"
#include "core/labels/label_regions.hpp"

namespace traygauge {

// Half or twice of any number here moves the MAPE of six pairs of the captures by 0.04 points at most
// (tests/evaluation/numbers.tsv), but for half of max_samples: 0.11. Twice of the least correlation or of the
// least visible share refuses cards.
struct CardAlignmentParams {
  CardPatternParams pattern;
  CardOutlineParams outline;
  CardPictureParams picture;
  CardRefinementParams refinement;
  CardConditionParams condition;

  // Blur of the print in each stage, standard deviation in pixels of the picture: the reach within which
  // edges still find each other. Each about half of the one before.
  double coarse_blur_px = 2.5;
  double medium_blur_px = 1.2;
  // Lens and pixels blur by 0.3 to 0.5 px; a sharper print would follow what the picture aliases. Up to
  // 2^1.5 times as much is tried for pictures out of focus.
  double finest_blur_px = 0.6;
  int coarse_iterations = 6;
  int iterations = 4;                 // of the other stages
  double max_correlation_lag = 0.25;  // of a first pose behind the best, to be refined as well
  // Of the mirror pose behind the best after the coarse stage, to be refined as well: they differ by 0.015
  // and more in the captures, by nothing from afar.
  double max_mirror_lag = 0.06;
  // Of one of the two behind the other after the medium stage, to be compared at the finest blur: the right
  // one is up to 0.007 behind there, of 700 views in 3.
  double max_medium_lag = 0.02;
  // Of the coarse and medium stages. Fewer do not hold twelve unknowns: of a card 90 px wide a sixteenth is
  // 200 pixels, and the coarse stage then ends up to 50 degrees away.
  int min_stage_samples = 600;
  int max_samples = 32'000;  // of the fine stage; of a larger card every second row, and so on

  double min_correlation = 0.4;  // of print and picture; faint prints reach 0.45, wrong places stay below 0.3
  double min_visible_fraction = 0.5;  // of the card
};

struct CardAlignment {
  Pose camera_from_table;                                 // mm
  PoseInformation information = PoseInformation::Zero();  // of a step as in `moved`, 1 / (rad, mm)²
  double correlation = 0.0;                               // of print and picture, over the inliers
  double inlier_fraction = 0.0;                           // of the visible card: what no fork or glare hides
  double visible_fraction = 0.0;  // of the card: labelled pixels over those of the whole
  double rms_gray = 0.0;          // robust standard deviation of the residuals
  double gain = 0.0;              // of the picture's grey values over the print's
  double blur_px = 0.0;           // of the print, where it fits best
  CardCondition condition;
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
// to lay the print on it and two poses each; grey values choose. Where they reject all, each side in turn is
// taken for another thing's edge and placed anew by the other three.
// card_not_found without a label, when less than half of the card is seen, or when nothing correlates.
Result<CardAlignment> align_card(ImageView<const std::uint8_t> gray, ImageView<const std::uint8_t> labels,
                                 const PixelBox& box, const LensModel& lens, const CardPattern& pattern,
                                 const CardAlignmentParams& params, CardAlignmentWorkspace& workspace);

}  // namespace traygauge
