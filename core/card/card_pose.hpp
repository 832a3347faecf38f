// The card's calibrated absolute pose from a homography (Zhang 2000, 3.1; the paper's alternative in V-A-3).
// Card frame: the pattern's x and y in mm, z into the table.
#pragma once

#include <cstdint>
#include <span>

#include "core/card/card.hpp"
#include "core/geometry/geometry.hpp"

namespace traygauge {

struct CardPose {
  Pose camera_from_card;  // mm
  double rms_ray = 0.0;   // of the reprojected points, in normalised image units
  double ambiguity_ratio =
      0.0;  // rms of the flipped pose over that of this one; near 1: undecided; 0: not tried
};

// A rigid card's pose near the homography, with no use of the points; false unless the card lies in front.
bool pose_from_homography(const Mat3& pattern_from_ray, Pose& camera_from_card);

// The map from rays to the pattern that a pose implies; pattern-facing poses have a positive determinant.
Mat3 homography_from_pose(const Pose& camera_from_card);

// Least squares of the reprojection error over the flagged tracks of one view, from both of the two poses
// between which a small plane leaves the choice (Schweighofer & Pinz 2006); the better one is returned.
bool card_pose_from_homography(const Mat3& pattern_from_ray, std::span<const CardTrack> tracks,
                               std::span<const std::uint8_t> inliers, CardView view,
                               const CardPoseParams& params, CardPose& pose);

// The pose that weak perspective cannot tell from this one: the depths of the card's points, along the line
// of sight to `centre_on_card`, mirrored.
Pose mirrored_pose(const Pose& camera_from_card, const Vec3& centre_on_card);

// The motion of the camera between two views of the resting card: second_from_first, mm.
Pose motion_from_card(const Pose& first_from_card, const Pose& second_from_card);

// The card's printed plane in the camera's frame, mm, normal towards the camera.
Plane plane_from_card_pose(const Pose& camera_from_card);

}  // namespace traygauge
