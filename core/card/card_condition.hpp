// Whether a card is seen whole and flat: each place of its print is looked for by itself, and the picture is
// asked whether a bent card would explain it better. Both are weighed against what the picture's own noise
// leaves open, so that they hold for small and blurred cards as for large and sharp ones.
#pragma once

#include "core/card/card_pattern.hpp"
#include "core/card/card_picture.hpp"
#include "core/geometry/geometry.hpp"

namespace traygauge {

struct CardConditionParams {
  // Contrast of a place's print against that of the whole card. Least of clean cards at 800 x 600 pixels:
  // 0.64, with more blur or noise 0.59, with a reflection 0.47; at 1600 x 1200: 0.71. At the edge of a hard
  // shadow that takes 45 % of the light 0.1 to 0.8. Under a finger, a napkin or food: −0.8 to 0.3.
  double min_contrast = 0.4;
  // A place counts as hidden where it is so many standard deviations below that, and is judged at all where
  // so many lie between that and 1: plain print does not say whether it is seen.
  double sure_sigmas = 1.0;
  double told_sigmas = 3.0;

  // Error of the print's place in the picture that noise does not explain, by the lens and by what blur does
  // to the print. A focal length that is 2 % off stays within it.
  double systematic_px = 0.05;
  // Of the bend, in squared standard deviations of three numbers. Some 460 views of flat cards in their place
  // have 9.3 at most, also those that lean by 0.5 to 4 degrees. At 800 x 600 seven of eight views of an edge
  // that is bent up by 2 mm have more, and all of one by 4 mm.
  double max_bend_square = 12.0;
};

struct CardCondition {
  double hidden_fraction = 0.0;  // of the print that was looked for
  double bend_mm = 0.0;          // rise between the card's middle and its edge where it is largest
  double bend_square = 0.0;      // of the bend, over its covariance
  bool is_doubtful = false;      // not seen whole, or not flat
};

// A print as it was aligned.
struct AlignedPrint {
  const CardPicture& picture;  // which has selected the print's pixels
  const CardModelSize& size;
  const CardPatternLevel& level;
  CardSampling sampling;
  const Pose& camera_from_table;
  const CardTone& tone;
  double cutoff_gray;
  double px_per_mm;
};

// From straight above a bend does not show; a card that leans as a whole shows in no print.
CardCondition judge_card(const AlignedPrint& print, const CardConditionParams& params);

}  // namespace traygauge
