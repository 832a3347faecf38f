#include "core/card/card_pose.hpp"

#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>
#include <random>
#include <vector>

#include "core/card/homography.hpp"
#include "tests/core/card/synthetic_card.hpp"

namespace traygauge {
namespace {

CardPose pose_of(const CardScene& scene, CardView view) {
  const std::vector<std::uint8_t> all(scene.tracks.size(), 1);
  Mat3 homography;
  CardPose pose;
  EXPECT_TRUE(fit_homography(scene.tracks, all, view, homography));
  EXPECT_TRUE(card_pose_from_homography(homography, scene.tracks, all, view, {}, pose));
  return pose;
}

TEST(CardPose, ExactCardGivesItsPoseAndTheMotion) {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    const CardScene scene = make_card_scene(random, {.count = 20});
    const CardPose first = pose_of(scene, &CardTrack::first);
    const CardPose second = pose_of(scene, &CardTrack::second);
    EXPECT_LT(first.rms_ray, 1e-9);
    EXPECT_LT((first.camera_from_card.rotation - scene.first_from_card.rotation).norm(), 1e-7);
    EXPECT_LT((first.camera_from_card.translation - scene.first_from_card.translation).norm(), 1e-5);
    const Pose motion = motion_from_card(first.camera_from_card, second.camera_from_card);
    EXPECT_LT((motion.rotation - scene.second_from_first.rotation).norm(), 1e-7);
    EXPECT_LT((motion.translation - scene.second_from_first.translation).norm(), 1e-4);
    const Plane plane = plane_from_card_pose(first.camera_from_card);
    EXPECT_GT(plane.height(Vec3::Zero()), 0.0) << "the camera is above the card";
    EXPECT_NEAR(plane.height(scene.first_from_card * Vec3(30.0, 10.0, 0.0)), 0.0, 1e-5);
  }
}

TEST(CardPose, HomographyOfAPoseIsItsInverse) {
  std::mt19937 random(3);
  const CardScene scene = make_card_scene(random, {.count = 5});
  const Mat3 homography = homography_from_pose(scene.first_from_card);
  for (const CardTrack& track : scene.tracks) {
    Vec2 mapped = Vec2::Zero();
    ASSERT_TRUE(map_ray(homography, track.first, mapped));
    EXPECT_LT((mapped - track.pattern_mm).norm(), 1e-9);
  }
  EXPECT_GT(homography.determinant(), 0.0);
  Pose pose;
  ASSERT_TRUE(pose_from_homography(homography, pose));
  EXPECT_LT((pose.translation - scene.first_from_card.translation).norm(), 1e-7);
}

// The reprojection error of OpenCV's planar solver, refined by its Levenberg-Marquardt, is never lower.
TEST(CardPose, IsAsGoodAsSolvePnp) {
  double worst_mm = 0.0;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    const CardScene scene = make_card_scene(random, {.count = 30, .noise_px = 0.3});
    const CardPose pose = pose_of(scene, &CardTrack::first);
    std::vector<cv::Point3d> objects;
    std::vector<cv::Point2d> rays;
    for (const CardTrack& track : scene.tracks) {
      objects.emplace_back(track.pattern_mm.x(), track.pattern_mm.y(), 0.0);
      rays.emplace_back(track.first.x(), track.first.y());
    }
    std::vector<cv::Mat> rotations;
    std::vector<cv::Mat> translations;
    cv::solvePnPGeneric(objects, rays, cv::Mat::eye(3, 3, CV_64F), cv::noArray(), rotations, translations,
                        false, cv::SOLVEPNP_IPPE);
    double best = 1e9;
    cv::Mat best_translation;
    for (std::size_t k = 0; k < rotations.size(); ++k) {
      cv::solvePnPRefineLM(objects, rays, cv::Mat::eye(3, 3, CV_64F), cv::noArray(), rotations[k],
                           translations[k], {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 100, 1e-12});
      std::vector<cv::Point2d> projected;
      cv::projectPoints(objects, rotations[k], translations[k], cv::Mat::eye(3, 3, CV_64F), cv::noArray(),
                        projected);
      double sum = 0.0;
      for (std::size_t i = 0; i < rays.size(); ++i) sum += std::pow(cv::norm(projected[i] - rays[i]), 2);
      const double rms = std::sqrt(sum / static_cast<double>(rays.size()));
      if (rms < best) {
        best = rms;
        best_translation = translations[k];
      }
    }
    EXPECT_LE(pose.rms_ray, best * (1.0 + 1e-6));
    const Vec3 reference(best_translation.at<double>(0), best_translation.at<double>(1),
                         best_translation.at<double>(2));
    worst_mm = std::max(worst_mm, (reference - pose.camera_from_card.translation).norm());
  }
  EXPECT_LT(worst_mm, 0.01);
}

// Far and small, frontal cards leave the tilt's sign open: both minima are tried and the ratio says so.
TEST(CardPose, ReportsTheFlipAmbiguity) {
  int better_than_blind = 0;
  std::vector<double> far_ratios;
  std::vector<double> near_ratios;
  for (unsigned seed = 1; seed <= 100; ++seed) {
    std::mt19937 random(seed);
    const CardScene far = make_card_scene(random, {.count = 40, .noise_px = 0.5, .distance_mm = 2500.0});
    const CardScene near = make_card_scene(random, {.count = 40, .noise_px = 0.3});
    const std::vector<std::uint8_t> all(40, 1);
    Mat3 homography;
    ASSERT_TRUE(fit_homography(far.tracks, all, &CardTrack::first, homography));
    CardPose blind;
    CardPose pose;
    ASSERT_TRUE(card_pose_from_homography(homography, far.tracks, all, &CardTrack::first,
                                          {.try_flipped = false}, blind));
    ASSERT_TRUE(card_pose_from_homography(homography, far.tracks, all, &CardTrack::first, {}, pose));
    EXPECT_LE(pose.rms_ray, blind.rms_ray * (1.0 + 1e-9)) << "seed " << seed;
    EXPECT_GE(pose.ambiguity_ratio, 1.0);
    EXPECT_EQ(blind.ambiguity_ratio, 0.0);
    if (pose.rms_ray < blind.rms_ray * (1.0 - 1e-6)) ++better_than_blind;
    far_ratios.push_back(pose.ambiguity_ratio);
    near_ratios.push_back(pose_of(near, &CardTrack::first).ambiguity_ratio);
  }
  std::sort(far_ratios.begin(), far_ratios.end());
  std::sort(near_ratios.begin(), near_ratios.end());
  EXPECT_GT(near_ratios[50], 2.0 * far_ratios[50]);
  EXPECT_GT(better_than_blind, 0);
  std::cout << "median ratio at 50 cm " << near_ratios[50] << ", at 250 cm " << far_ratios[50] << ", flipped "
            << better_than_blind << " of 100\n";
}

}  // namespace
}  // namespace traygauge
