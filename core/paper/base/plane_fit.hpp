// The plane that most points lie on: RANSAC, then least squares on its inliers.
#pragma once

#include <cstdint>
#include <span>

#include "core/base/random.hpp"
#include "core/geometry/geometry.hpp"

namespace traygauge::paper {

struct PlaneFitParams {
  double threshold_mm = 3.0;       // distance of an inlier; rough borders need twice what exact ones do
  int min_iterations = 0;          // samples drawn however good the first ones are
  int max_iterations = 500;        // bound of the loop
  double confidence = 0.9999;      // that one sample was free of outliers
  double min_triangle_mm2 = 100;   // samples that span less say little about the normal
  double min_facing_cosine = 0.4;  // of the line of sight to the normal; a flatter view sees no dish
  int refits = 4;                  // rounds of least squares and new inliers
  int min_inliers = 12;            // fewer are no plane
};

struct PlaneFit {
  Plane plane;  // normal towards the camera
  int inliers = 0;
  int iterations = 0;
  double rms_mm = 0.0;          // of the inliers' distances
  double weak_spread_mm = 0.0;  // standard deviation of the inliers along the plane where they spread least
};

// Least-squares plane through at least three points, normal towards the camera (the origin).
// False when they lie on a line.
bool fit_plane_least_squares(std::span<const Vec3> points_mm, Plane& plane);

// The plane with the smallest truncated squared distances (MSAC) among random triples, refitted. Reorders
// `points_mm` so that the inliers come first. False when fewer than `min_inliers` agree.
bool fit_plane(std::span<Vec3> points_mm, const PlaneFitParams& params, Random& random, PlaneFit& fit);

}  // namespace traygauge::paper
