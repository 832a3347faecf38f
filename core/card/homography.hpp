// Homographies between the rays of a view and the card's pattern in mm (Hartley & Zisserman, chapter 4).
// Scaled so that the third coordinate of a mapped ray is positive in front of the card's horizon.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/card/card.hpp"
#include "core/geometry/geometry.hpp"

namespace traygauge {

// False when the ray meets the card's plane behind the camera or at infinity.
inline bool map_ray(const Mat3& pattern_from_ray, const Vec2& ray, Vec2& pattern) {
  const Vec3 mapped = pattern_from_ray * ray.homogeneous();
  if (!(mapped.z() > 0.0)) return false;
  pattern = mapped.head<2>() / mapped.z();
  return true;
}

inline constexpr int kHomographySample = 4;  // eight unknowns, two of a point

// The exact map of four points in general position, with the scale's sign set by the first; false when three
// of them are collinear.
bool homography_from_four(const std::array<Vec2, 4>& rays, const std::array<Vec2, 4>& pattern,
                          Mat3& pattern_from_ray);

// Least squares of the distances on the pattern over the flagged tracks: normalised linear solution, then
// Gauss-Newton. False with fewer than four tracks or when they do not fix a homography.
bool fit_homography(std::span<const CardTrack> tracks, std::span<const std::uint8_t> inliers, CardView view,
                    Mat3& pattern_from_ray);

}  // namespace traygauge
