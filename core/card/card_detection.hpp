// The card in the first view: a homography to its pattern by RANSAC (paper III-A-3).
#pragma once

#include <cstdint>
#include <span>

#include "core/base/random.hpp"
#include "core/base/status.hpp"
#include "core/card/card.hpp"
#include "core/geometry/geometry.hpp"

namespace traygauge {

struct CardFit {
  Mat3 pattern_from_first = Mat3::Identity();  // rays of the first view to mm on the pattern
  std::span<const std::uint8_t> inliers;       // a flag for each track, in the workspace
  int inlier_count = 0;
  int iterations = 0;
  double rms_mm = 0.0;              // of the inliers, on the pattern
  double log10_false_alarms = 0.0;  // expected number of homographies as good among random matches
};

// card_not_found when fewer than min_tracks agree on a homography, when chance could do as much, when the
// inliers crowd in one place or line, or when no rigid card seen from its printed side projects like that;
// `fit` then still counts the inliers that were not enough. O(iterations × tracks).
Status find_card(std::span<const CardTrack> tracks, const CardModelSize& size, const CardParams& params,
                 Random& random, CardWorkspace& workspace, CardFit& fit);

}  // namespace traygauge
