// Exact cards seen from two random views, with noise and wrong matches on demand.
#pragma once

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "core/card/card.hpp"
#include "core/geometry/geometry.hpp"

namespace traygauge {

inline constexpr double kCardFocalPx = 1400.0;

struct CardScene {
  Pose first_from_card;  // mm
  Pose second_from_card;
  Pose second_from_first;
  double baseline_mm = 0.0;
  std::vector<CardTrack> tracks;
  std::vector<std::uint8_t> is_true;  // per track: not an outlier
};

struct SceneOptions {
  int count = 60;
  double noise_px = 0.0;
  double outlier_fraction = 0.0;
  double distance_mm = 500.0;
  double baseline_mm = 150.0;
  double max_tilt_rad = 0.6;
};

// The point nearest to both rays; `second_from_first` has a unit baseline.
inline Vec3 triangulate_midpoint(const Pose& second_from_first, const Vec2& first, const Vec2& second) {
  const Pose first_from_second = second_from_first.inverse();
  const Vec3 a = first.homogeneous().normalized();
  const Vec3 b = (first_from_second.rotation * second.homogeneous()).normalized();
  const Vec3& c = first_from_second.translation;
  Eigen::Matrix2d m;
  m << 1.0, -a.dot(b), a.dot(b), -1.0;
  const Vec2 depth = m.inverse() * Vec2(a.dot(c), b.dot(c));
  return 0.5 * (depth.x() * a + c + depth.y() * b);
}

inline Vec2 project(const Pose& camera_from_card, const Vec2& pattern_mm) {
  const Vec3 point = camera_from_card * Vec3(pattern_mm.x(), pattern_mm.y(), 0.0);
  return point.head<2>() / point.z();
}

// A camera `distance` from the card's centre, its axis there up to 0.1 rad, tilted as stated, rolled at will.
inline Pose tilt_over_card(const CardModelSize& size, double tilt, double azimuth, double roll,
                           double distance, const Vec2& off_axis) {
  const Mat3 rotation = (Eigen::AngleAxisd(roll, Vec3::UnitZ()) *
                         Eigen::AngleAxisd(tilt, Vec3(std::cos(azimuth), std::sin(azimuth), 0.0)))
                            .toRotationMatrix();
  const Vec3 centre(0.5 * size.width_mm, 0.5 * size.height_mm, 0.0);
  return {rotation, Vec3(off_axis.x(), off_axis.y(), 1.0).normalized() * distance - rotation * centre};
}

inline CardScene make_card_scene(std::mt19937& random, const SceneOptions& options,
                                 const CardModelSize& size = {}) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::normal_distribution<double> gauss;
  CardScene scene;
  const double turn = 2.0 * std::numbers::pi;
  scene.first_from_card =
      tilt_over_card(size, options.max_tilt_rad * unit(random), turn * unit(random), turn * unit(random),
                     options.distance_mm, Vec2(0.3 * (unit(random) - 0.5), 0.3 * (unit(random) - 0.5)));
  // The second camera orbits the card's centre: the chord is the baseline.
  const Vec3 centre = scene.first_from_card * Vec3(0.5 * size.width_mm, 0.5 * size.height_mm, 0.0);
  const double direction = turn * unit(random);
  const Mat3 orbit = Eigen::AngleAxisd(2.0 * std::asin(0.5 * options.baseline_mm / options.distance_mm),
                                       Vec3(std::cos(direction), std::sin(direction), 0.0))
                         .toRotationMatrix();
  scene.second_from_first = {orbit, centre - orbit * centre};
  scene.baseline_mm = scene.second_from_first.translation.norm();
  scene.second_from_card = {orbit * scene.first_from_card.rotation,
                            scene.second_from_first * scene.first_from_card.translation};
  Pose unit_pose = scene.second_from_first;
  unit_pose.translation.normalize();
  const double noise = options.noise_px / kCardFocalPx;
  for (int i = 0; i < options.count; ++i) {
    CardTrack track;
    track.pattern_mm = Vec2(unit(random) * size.width_mm, unit(random) * size.height_mm);
    track.first =
        project(scene.first_from_card, track.pattern_mm) + noise * Vec2(gauss(random), gauss(random));
    track.second =
        project(scene.second_from_card, track.pattern_mm) + noise * Vec2(gauss(random), gauss(random));
    track.point_in_first = triangulate_midpoint(unit_pose, track.first, track.second);
    const bool is_outlier = unit(random) < options.outlier_fraction;
    if (is_outlier) track.pattern_mm = Vec2(unit(random) * size.width_mm, unit(random) * size.height_mm);
    scene.tracks.push_back(track);
    scene.is_true.push_back(is_outlier ? 0 : 1);
  }
  return scene;
}

// Rays and pattern points that have nothing to do with each other.
inline std::vector<CardTrack> random_tracks(std::mt19937& random, int count, const CardModelSize& size = {}) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<CardTrack> tracks(static_cast<std::size_t>(count));
  for (CardTrack& track : tracks) {
    track.pattern_mm = Vec2(unit(random) * size.width_mm, unit(random) * size.height_mm);
    track.first = Vec2(unit(random) - 0.5, 0.75 * (unit(random) - 0.5));
    track.second = Vec2(unit(random) - 0.5, 0.75 * (unit(random) - 0.5));
    track.point_in_first = Vec3(track.first.x(), track.first.y(), 1.0) * (2.0 + 2.0 * unit(random));
  }
  return tracks;
}

inline double angle_between(const Mat3& a, const Mat3& b) {
  return Eigen::AngleAxisd(a.transpose() * b).angle();
}

}  // namespace traygauge
