// Exact scenes with known motion for the tests of the pose stage.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include "core/base/arena.hpp"
#include "core/base/random.hpp"
#include "core/paper/pose/epipolar.hpp"
#include "core/paper/pose/relative_pose.hpp"
#include "tests/support/cameras.hpp"

namespace traygauge::test {

inline constexpr double kFocalPx = 1388.0;
inline constexpr double kDegrees = 180.0 / std::numbers::pi;

inline double uniform(Random& random, double low, double high) {
  return low + (high - low) * random.uniform();
}

// Sum of twelve uniforms: near enough to a normal variable, and the same everywhere.
inline double normal(Random& random) {
  double sum = -6.0;
  for (int i = 0; i < 12; ++i) sum += random.uniform();
  return sum;
}

inline Vec3 random_direction(Random& random) {
  Vec3 v;
  do {
    v = Vec3(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
  } while (v.norm() < 0.1 || v.norm() > 1.0);
  return v.normalized();
}

inline Pose random_motion(Random& random, double max_angle_rad) {
  const Vec3 axis = random_direction(random);
  const double angle = uniform(random, -max_angle_rad, max_angle_rad);
  return {Eigen::AngleAxisd(angle, axis).toRotationMatrix(), random_direction(random)};
}

inline RayMatch project(const Vec3& point_in_first, const Pose& second_from_first) {
  return {point_in_first.hnormalized(), (second_from_first * point_in_first).hnormalized()};
}

struct Scene {
  Pose second_from_first;
  std::vector<RayMatch> matches;
  std::vector<Vec3> points_in_first;  // of the first, true matches
};

struct TrayOptions {
  int matches = 600;
  double angle_deg = 15.0;  // between the views, seen from the tray
  double noise_px = 0.0;
  double outlier_fraction = 0.0;
  double max_height_mm = 35.0;  // of the food; 0: all on the table
};

// Table and card (4 of 10 points), a dish's rim 22 mm high (2) and food on it (4), 45 cm below the camera.
inline Scene tray_scene(std::uint64_t seed, const TrayOptions& options) {
  Random random(seed);
  const double tilt = uniform(random, 0.1, 0.5);
  const double azimuth = uniform(random, 0.0, 6.28);
  const Pose first = camera_above(tilt, azimuth, 450.0);
  Pose second = camera_above(tilt, azimuth, 450.0);
  const Vec3 axis = random_direction(random).cross(first.rotation.row(2).transpose()).normalized();
  second.rotation *= Eigen::AngleAxisd(options.angle_deg / kDegrees, axis).toRotationMatrix();
  Scene scene;
  scene.second_from_first.rotation = second.rotation * first.rotation.transpose();
  scene.second_from_first.translation =
      second.translation - scene.second_from_first.rotation * first.translation;
  const int outliers = static_cast<int>(options.outlier_fraction * options.matches);
  const double scale = options.max_height_mm / 35.0;
  for (int i = 0; i < options.matches - outliers; ++i) {
    Vec3 world(uniform(random, -190, 190), uniform(random, -140, 140), 0.0);
    const double kind = random.uniform();
    const double turn = uniform(random, 0.0, 6.283);
    if (kind > 0.8) {
      world = Vec3(130 * std::cos(turn), 130 * std::sin(turn), scale * 22.0);
    } else if (kind > 0.4) {
      const double radius = 100 * std::sqrt(random.uniform());
      world = Vec3(radius * std::cos(turn), radius * std::sin(turn),
                   scale * (4.5 + 30.0 * (1.0 - radius / 100.0) * random.uniform()));
    }
    scene.points_in_first.push_back(first * world);
    RayMatch match = project(scene.points_in_first.back(), scene.second_from_first);
    const double sigma = options.noise_px / kFocalPx;
    match.first += sigma * Vec2(normal(random), normal(random));
    match.second += sigma * Vec2(normal(random), normal(random));
    scene.matches.push_back(match);
  }
  for (int i = 0; i < outliers; ++i) {
    const auto anywhere = [&] { return Vec2(uniform(random, -0.5, 0.5), uniform(random, -0.4, 0.4)); };
    scene.matches.push_back({anywhere(), anywhere()});
  }
  return scene;
}

// The stage with memory of its own.
class Estimation {
 public:
  explicit Estimation(std::size_t max_matches = 4000, std::size_t max_noise = 4000) {
    ArenaPlan plan;
    workspace.allocate(plan, max_matches, max_noise);
    block_.resize(plan.high_water_bytes() / sizeof(Line));
    Arena arena(std::as_writable_bytes(std::span(block_)));
    workspace.allocate(arena, max_matches, max_noise);
  }

  Status run(const std::vector<RayMatch>& matches, std::uint64_t seed, double focal_px = kFocalPx) {
    Random random(seed);
    inliers.assign(matches.size(), 7);
    return paper::estimate_relative_pose(matches, focal_px, params, random, workspace, pose, inliers);
  }
  Status refine(const std::vector<RayMatch>& matches, const Pose& start, double focal_px = kFocalPx) {
    Random random(1);
    inliers.assign(matches.size(), 7);
    return paper::refine_relative_pose(matches, focal_px, params, start, random, workspace, pose, inliers);
  }

  paper::RelativePoseParams params;
  paper::RelativePoseWorkspace workspace;
  paper::RelativePose pose;
  std::vector<std::uint8_t> inliers;

 private:
  struct alignas(kArenaAlignmentBytes) Line {
    std::byte bytes[kArenaAlignmentBytes];
  };
  std::vector<Line> block_;
};

// Eq. (1): the sum of max(threshold − distance, 0).
inline double inlier_fitness(const Mat3& essential, std::span<const RayMatch> matches, double focal_px,
                             double threshold_px) {
  double sum = 0.0;
  for (const RayMatch& match : matches) {
    const double distance_px = paper::symmetric_epipolar_distance_px(essential, match, focal_px);
    sum += std::max(threshold_px - distance_px, 0.0);
  }
  return sum;
}

}  // namespace traygauge::test
