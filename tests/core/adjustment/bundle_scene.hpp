// A tray with card, dish and textured table in closed form, as the stages before the bundle adjustment would
// deliver it, with errors as they state them.
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/adjustment/bundle_adjustment.hpp"
#include "tests/core/paper/motion_scenes.hpp"

namespace traygauge::test {

struct BundleSceneOptions {
  double card_turn_sigma_deg = 0.02;
  double card_shift_sigma_mm = 0.05;
  double lie_tilt_sigma_deg = 0.1;
  double lie_raised_sigma_mm = 0.1;
  double track_sigma_px = 0.1;
  double track_error_factor = 1.0;  // the tracks are that much worse than they say
  int table_tracks = 250;
  int dish_tracks = 250;
  double outlier_fraction = 0.0;           // of all tracks: anywhere within 40 px
  bool is_on_tray = false;                 // 440 by 320 mm; the table beyond it is 3 mm lower
  double lowered_fraction = 0.0;           // of the table's tracks: 3 mm lower, anywhere
  double raised_fraction = 0.0;            // of them: a napkin and cutlery, 0.5 to 15 mm higher
  Vec3 table_moved_mm = Vec3::Zero();      // all of the table's tracks, between the views
  double outline_sigma_px = 0.5;           // the same over four points
  int outline_points = 240;                // a view
  double outline_occluded_fraction = 0.0;  // runs of the outline that lie elsewhere
  DishModel dish;
};

inline DishModel dinner_plate() {
  DishModel model;
  model.outer_size_mm = {260.0, 260.0};
  model.rim_height_mm = 22.0;
  model.bottom_height_mm = 4.5;
  model.profile_points[0] = {0.0, 21.4};
  model.profile_points[1] = {1.6, 22.0};
  model.profile_size = 2;
  return model;
}

inline DishModel oval_plate() {
  DishModel model;
  model.outer_size_mm = {300.0, 210.0};
  model.rim_height_mm = 24.0;
  model.bottom_height_mm = 4.0;
  model.profile_points[0] = {0.0, 23.4};
  model.profile_size = 1;
  return model;
}

struct BundleScene {
  TableCameras camera_from_table;
  CardTilt card;
  DishPose place;
  std::array<CardPrior, 2> cards;
  std::vector<PointTrack> tracks;
  std::array<std::vector<Vec2>, 2> outlines;
  Vec3 card_middle_mm{42.8, -27.0, 0.2};
  std::vector<DishModel> candidates;
  std::vector<BundleDish> dishes;

  BundleInput input() {
    dishes = {{{outlines[0], outlines[1]}, candidates}};
    return {cards, card_middle_mm, tracks, dishes, {kFocalPx, kFocalPx}};
  }
};

inline Vec2 ray_of(const Pose& camera_from_table, const Vec3& point_mm) {
  return (camera_from_table * point_mm).hnormalized();
}

inline Vec2 noise_ray(Random& random, double sigma_px) {
  return Vec2(normal(random), normal(random)) * (sigma_px / kFocalPx);
}

// Where the camera sees the outline: the upper edge, or on the near side the lower end of its upright side,
// where both bound a convex solid: the outermost of both in the picture.
inline Vec2 outline_ray(const DishPose& place, const Pose& camera_from_table, double angle_rad) {
  const Vec2 axis(std::cos(place.azimuth_rad), std::sin(place.azimuth_rad));
  const Vec2 across(-axis.y(), axis.x());
  const Vec2 local(0.5 * place.size_mm[0] * std::cos(angle_rad),
                   0.5 * place.size_mm[1] * std::sin(angle_rad));
  const Vec2 flat = place.centre_mm + local.x() * axis + local.y() * across;
  const Vec2 out_local(std::cos(angle_rad) / place.size_mm[0], std::sin(angle_rad) / place.size_mm[1]);
  const Vec2 outward = out_local.x() * axis + out_local.y() * across;
  const Vec3 centre = camera_centre_mm(camera_from_table);
  const Vec3 edge(flat.x(), flat.y(), place.edge_height_mm);
  const bool is_from_outside = outward.dot(centre.head<2>() - flat) > 0.0;
  return ray_of(camera_from_table, is_from_outside ? edge - place.edge_drop_mm * Vec3::UnitZ() : edge);
}

inline void add_tracks(Random& random, const BundleSceneOptions& options, BundleScene& scene) {
  const auto add = [&](const Vec3& point, const Vec3& moved_point, std::uint8_t label) {
    PointTrack track;
    track.first = ray_of(scene.camera_from_table[0], point);
    track.second = ray_of(scene.camera_from_table[1], moved_point) +
                   noise_ray(random, options.track_sigma_px * options.track_error_factor);
    track.sigma_px = static_cast<float>(options.track_sigma_px);
    track.label = label;
    if (random.uniform() < options.outlier_fraction) track.second += noise_ray(random, 20.0);
    scene.tracks.push_back(track);
  };
  const Vec2 centre = scene.place.centre_mm;
  for (int i = 0; i < options.table_tracks;) {
    const Vec2 offset = options.is_on_tray ? Vec2(uniform(random, -330, 330), uniform(random, -260, 260))
                                           : Vec2(uniform(random, -230, 230), uniform(random, -170, 170));
    if (offset.norm() < 140.0) continue;
    ++i;
    const bool is_beyond = std::abs(offset.x() - 50.0) > 220.0 || std::abs(offset.y()) > 160.0;
    double height = options.is_on_tray && is_beyond ? -3.0 : 0.0;
    const double draw = random.uniform();
    if (draw < options.lowered_fraction)
      height = -3.0;
    else if (draw < options.lowered_fraction + options.raised_fraction)
      height = uniform(random, 0.5, 15.0);
    const Vec3 point(centre.x() + offset.x(), centre.y() + offset.y(), height);
    add(point, point + options.table_moved_mm, 0);
  }
  for (int i = 0; i < options.dish_tracks; ++i) {
    const double radius = 100.0 * std::sqrt(random.uniform());
    const double angle = uniform(random, 0.0, 2.0 * std::numbers::pi);
    const Vec3 point(centre.x() + radius * std::cos(angle), centre.y() + radius * std::sin(angle),
                     uniform(random, 4.0, 40.0));
    add(point, point, 2);
  }
}

inline void add_outlines(Random& random, const BundleSceneOptions& options, BundleScene& scene) {
  constexpr int kCorrelated = 4;
  for (std::size_t view = 0; view < 2; ++view) {
    const Pose& camera = scene.camera_from_table[view];
    double shift = 0.0;
    const double occluded_from = uniform(random, 0.0, 1.0 - options.outline_occluded_fraction);
    for (int i = 0; i < options.outline_points; ++i) {
      const double share = static_cast<double>(i) / options.outline_points;
      const double angle = 2.0 * std::numbers::pi * share;
      if (i % kCorrelated == 0) shift = options.outline_sigma_px * normal(random);
      const Vec2 ray = outline_ray(scene.place, camera, angle);
      const Vec2 ahead = outline_ray(scene.place, camera, angle + 0.01);
      const Vec2 along = (ahead - ray).normalized();
      const bool is_occluded =
          share > occluded_from && share < occluded_from + options.outline_occluded_fraction;
      const double off = is_occluded ? 25.0 : shift;
      scene.outlines[view].push_back(ray + off / kFocalPx * Vec2(-along.y(), along.x()));
    }
  }
}

inline BundleScene bundle_scene(std::uint64_t seed, const BundleSceneOptions& options) {
  Random random(seed);
  BundleScene scene;
  const DishModel model = options.dish.outer_size_mm[0] > 0.0 ? options.dish : dinner_plate();
  scene.candidates = {model};
  // Prior errors of the dish as DishPoseParams states them.
  scene.place.centre_mm = {uniform(random, -170, -130), uniform(random, -60, 60)};
  scene.place.azimuth_rad =
      model.outer_size_mm[0] == model.outer_size_mm[1] ? 0.0 : uniform(random, -1.5, 1.5);
  scene.place.edge_height_mm = edge_height_mm(model) + 0.5 * normal(random);
  scene.place.size_mm = {model.outer_size_mm[0] + 0.5 * normal(random),
                         model.outer_size_mm[1] + 0.5 * normal(random)};
  scene.place.edge_drop_mm = 1.0 + normal(random);

  const double azimuth = uniform(random, 0.0, 2.0 * std::numbers::pi);
  const double tilt = uniform(random, 0.05, 0.5);
  const double relative = uniform(random, 0.15, 0.5);
  const double distance = uniform(random, 420.0, 600.0);
  const double turn = uniform(random, 0.0, 2.0 * std::numbers::pi);
  const Pose centred{Mat3::Identity(), Vec3(-scene.place.centre_mm.x(), -scene.place.centre_mm.y(), 0.0)};
  const Vec3 side(std::cos(turn), std::sin(turn), 0.0);
  const Pose swung{Eigen::AngleAxisd(relative, side).toRotationMatrix(), Vec3::Zero()};
  scene.camera_from_table[0] = camera_above(tilt, azimuth, distance) * centred;
  scene.camera_from_table[1] =
      camera_above(tilt, azimuth, distance * uniform(random, 0.9, 1.1)) * swung * centred;

  constexpr double kRadians = std::numbers::pi / 180.0;
  scene.card.tilt_rad = Vec2(normal(random), normal(random)) * (options.lie_tilt_sigma_deg * kRadians);
  scene.card.raised_mm = options.lie_raised_sigma_mm * normal(random);
  const Pose table_from_card = scene.card.table_from_card(scene.card_middle_mm);
  const double turn_sigma = options.card_turn_sigma_deg * kRadians;
  for (std::size_t view = 0; view < 2; ++view) {
    Vec6 step;
    for (int k = 0; k < 6; ++k) step[k] = normal(random) * (k < 3 ? turn_sigma : options.card_shift_sigma_mm);
    CardPrior& card = scene.cards[view];
    card.camera_from_table = moved(scene.camera_from_table[view] * table_from_card, step);
    card.information.diagonal() << Vec3::Constant(1.0 / (turn_sigma * turn_sigma)),
        Vec3::Constant(1.0 / (options.card_shift_sigma_mm * options.card_shift_sigma_mm));
  }
  add_tracks(random, options, scene);
  add_outlines(random, options, scene);
  return scene;
}

// The step from the pose found to the true one.
inline Vec6 pose_error(const Pose& found, const Pose& truth) {
  return card_deviation({found, Mat6::Zero()}, truth);
}

// How high the plane z = 0 of the frame found lies over the true table, at a place of the true table frame.
inline double table_error_mm(const Pose& found, const Pose& truth, const Vec2& place_mm) {
  const Pose found_from_truth = found.inverse() * truth;
  return -(found_from_truth * Vec3(place_mm.x(), place_mm.y(), 0.0)).z();
}

inline double table_tilt_deg(const Pose& found, const Pose& truth) {
  const Vec3 up = (found.inverse() * truth).rotation.col(2);
  return std::atan2(up.head<2>().norm(), up.z()) * kDegrees;
}

}  // namespace traygauge::test
