#include "core/card/homography.hpp"

#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>
#include <random>
#include <vector>

#include "core/card/card_pose.hpp"
#include "tests/core/card/synthetic_card.hpp"

namespace traygauge {
namespace {

double rms_mm(const Mat3& homography, const std::vector<CardTrack>& tracks) {
  double sum = 0.0;
  for (const CardTrack& track : tracks) {
    Vec2 mapped = Vec2::Zero();
    EXPECT_TRUE(map_ray(homography, track.first, mapped));
    sum += (mapped - track.pattern_mm).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(tracks.size()));
}

TEST(Homography, FourPointsAreExact) {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    std::mt19937 random(seed);
    const CardScene scene = make_card_scene(random, {.count = 4});
    std::array<Vec2, 4> rays;
    std::array<Vec2, 4> pattern;
    for (std::size_t i = 0; i < 4; ++i) {
      rays[i] = scene.tracks[i].first;
      pattern[i] = scene.tracks[i].pattern_mm;
    }
    Mat3 homography;
    ASSERT_TRUE(homography_from_four(rays, pattern, homography)) << "seed " << seed;
    EXPECT_LT(rms_mm(homography, scene.tracks), 1e-6) << "seed " << seed;
  }
}

TEST(Homography, RefusesCollinearPoints) {
  const std::array<Vec2, 4> line = {Vec2(0, 0), Vec2(1, 1), Vec2(2, 2), Vec2(3, 5)};
  const std::array<Vec2, 4> square = {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)};
  Mat3 homography;
  EXPECT_FALSE(homography_from_four(line, square, homography));
  EXPECT_FALSE(homography_from_four(square, line, homography));
  std::vector<CardTrack> tracks(12);
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    tracks[i].pattern_mm = Vec2(3.0 * static_cast<double>(i), 20.0);
    tracks[i].first = Vec2(0.01 * static_cast<double>(i), 0.1);
  }
  const std::vector<std::uint8_t> all(tracks.size(), 1);
  EXPECT_FALSE(fit_homography(tracks, all, &CardTrack::first, homography));
  EXPECT_FALSE(fit_homography(std::vector<CardTrack>(12), all, &CardTrack::first, homography));
}

// OpenCV minimises the same distances; neither may be better by more than rounding.
TEST(Homography, LeastSquaresEqualOpenCv) {
  for (unsigned seed = 1; seed <= 100; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    const CardScene scene =
        make_card_scene(random, {.count = 8 + static_cast<int>(seed % 60), .noise_px = 0.5});
    const std::vector<std::uint8_t> all(scene.tracks.size(), 1);
    Mat3 homography;
    ASSERT_TRUE(fit_homography(scene.tracks, all, &CardTrack::first, homography));
    std::vector<cv::Point2d> rays;
    std::vector<cv::Point2d> pattern;
    for (const CardTrack& track : scene.tracks) {
      rays.emplace_back(track.first.x(), track.first.y());
      pattern.emplace_back(track.pattern_mm.x(), track.pattern_mm.y());
    }
    const cv::Mat reference = cv::findHomography(rays, pattern, 0);
    Mat3 expected;
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) expected(r, c) = reference.at<double>(r, c);
    }
    expected *= homography(2, 2) / expected(2, 2);
    EXPECT_LE(rms_mm(homography, scene.tracks), rms_mm(expected, scene.tracks) * (1.0 + 1e-6));
    EXPECT_LT((homography - expected).norm(), 1e-3 * homography.norm());
  }
}

TEST(Homography, ExactCardHasNoResidualAndKeepsOrientation) {
  for (unsigned seed = 1; seed <= 100; ++seed) {
    std::mt19937 random(seed);
    const CardScene scene = make_card_scene(random, {.count = 30});
    const std::vector<std::uint8_t> all(scene.tracks.size(), 1);
    Mat3 homography;
    ASSERT_TRUE(fit_homography(scene.tracks, all, &CardTrack::first, homography)) << "seed " << seed;
    EXPECT_LT(rms_mm(homography, scene.tracks), 1e-9) << "seed " << seed;
    EXPECT_GT(homography.determinant(), 0.0) << "seed " << seed;
  }
}

}  // namespace
}  // namespace traygauge
