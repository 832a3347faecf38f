// The plane of the card's print in the first camera's frame; the table lies a card's thickness below it.
#pragma once

#include <cstdint>
#include <span>

#include "core/base/random.hpp"
#include "core/base/status.hpp"
#include "core/geometry/geometry.hpp"
#include "core/paper/card/card_scale.hpp"

namespace traygauge::paper {

// RANSAC over the flagged tracks' points of the sparse cloud, then least squares on the inliers; or the
// card's absolute pose (CardPlaneParams::source). mm; the normal points to the camera; the table is
// `card_plane_in_first.raised(-thickness)`. table_not_found when too few points agree or nearly on a line.
Status fit_card_plane(std::span<const CardTrack> tracks, std::span<const std::uint8_t> inliers,
                      double card_length_mm, double mm_per_baseline, const CardScaleParams& params,
                      Random& random, CardScaleWorkspace& workspace, Plane& card_plane_in_first);

}  // namespace traygauge::paper
