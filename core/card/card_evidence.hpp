// Whether a homography can be the card: against chance, against degenerate sets, against impossible views.
#pragma once

#include <cstdint>
#include <span>

#include "core/card/card.hpp"
#include "core/geometry/geometry.hpp"

namespace traygauge {

// Decimal logarithm of the number of false alarms: how many homographies through four of these tracks are
// expected to have this many inliers if all matches were random (Moisan & Stival 2004, eq. 7). Inliers that
// share a place of the pattern count once.
double log10_false_alarms(std::span<const CardTrack> tracks, std::span<const std::uint8_t> inliers,
                          double inlier_mm, const CardModelSize& size);

// Standard deviation of the inliers' places on the pattern in the direction in which they vary least.
double least_spread_mm(std::span<const CardTrack> tracks, std::span<const std::uint8_t> inliers);

// Whether the homography is that of a rigid card of this size, printed side up, at a possible distance and
// tilt.
bool is_view_of_card(const Mat3& pattern_from_ray, const CardModelSize& size,
                     const CardDetectionParams& params);

}  // namespace traygauge
