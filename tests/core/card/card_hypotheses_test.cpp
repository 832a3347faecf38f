// Poses that an outline allows: the true one is among them, and three sides say where the fourth lies.
#include "core/card/card_hypotheses.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "tests/core/card/card_render.hpp"
#include "tests/support/cameras.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

const CardModelSize kPosedCard{};

Pose random_card_view(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  return look_at_card(kPosedCard, 300.0 + 300.0 * unit(random), 2.0 + 45.0 * unit(random),
                      360.0 * unit(random), 360.0 * unit(random),
                      Vec2(500.0 + 600.0 * unit(random), 400.0 + 400.0 * unit(random)));
}

CardOutline outline_seen(const Pose& camera_from_table) {
  CardOutline outline;
  const std::array<Vec2, 4> corners = print_corners_mm(kPosedCard);
  for (std::size_t i = 0; i < 4; ++i) {
    outline.corners[i] =
        (camera_from_table * print_point_mm(corners[i], kPosedCard.thickness_mm)).hnormalized();
  }
  return outline;
}

TEST(CardHypotheses, HoldTheTruePoseWhicheverCornerComesFirst) {
  std::mt19937 random(test::random_seed());
  for (int round = 0; round < 100; ++round) {
    const Pose truth = random_card_view(random);
    const CardOutline seen = outline_seen(truth);
    for (std::size_t turn = 0; turn < 4; ++turn) {
      CardOutline turned;
      for (std::size_t i = 0; i < 4; ++i) turned.corners[i] = seen.corners[(i + turn) % 4];
      std::array<Pose, kPosesPerOutline> storage;
      BoundedList<Pose> poses(storage);
      list_poses(turned, kPosedCard, poses);
      ASSERT_EQ(poses.size(), kPosesPerOutline);
      double least_deg = 180.0;
      double least_mm = 1e9;
      for (const Pose& pose : poses) {
        EXPECT_NEAR(pose.rotation.determinant(), 1.0, 1e-6);
        const double deg = test::rotation_error_deg(pose, truth);
        if (deg < least_deg) least_mm = (pose.translation - truth.translation).norm();
        least_deg = std::min(least_deg, deg);
      }
      EXPECT_LT(least_deg, 1e-4);
      EXPECT_LT(least_mm, 1e-3);
    }
  }
}

// The mirrored pose sees the print's middle at the same place, and nearly the same outline.
TEST(CardHypotheses, HoldMirroredPosesThatLookAlike) {
  std::mt19937 random(test::random_seed());
  const Vec3 middle =
      print_point_mm({0.5 * kPosedCard.width_mm, 0.5 * kPosedCard.height_mm}, kPosedCard.thickness_mm);
  for (int round = 0; round < 50; ++round) {
    std::array<Pose, kPosesPerOutline> storage;
    BoundedList<Pose> poses(storage);
    list_poses(outline_seen(random_card_view(random)), kPosedCard, poses);
    ASSERT_EQ(poses.size() % 2, 0U);
    for (std::size_t i = 0; i < poses.size(); i += 2) {
      const Vec2 one = (poses[i] * middle).hnormalized();
      const Vec2 other = (poses[i + 1] * middle).hnormalized();
      EXPECT_LT((one - other).norm(), 1e-6);
      const Vec3 sight = (poses[i] * middle).normalized();
      EXPECT_NEAR(sight.dot(poses[i].rotation.col(2)), sight.dot(poses[i + 1].rotation.col(2)), 1e-6);
    }
  }
}

TEST(CardHypotheses, GoNoFurtherThanThereIsRoomFor) {
  std::mt19937 random(3);
  std::array<Pose, 3> storage;
  BoundedList<Pose> poses(storage);
  list_poses(outline_seen(random_card_view(random)), kPosedCard, poses);
  EXPECT_EQ(poses.size(), 3U);
  CardOutline flat;
  for (std::size_t i = 0; i < 4; ++i) flat.corners[i] = Vec2(0.1 * static_cast<double>(i), 0.0);
  poses.clear();
  list_poses(flat, kPosedCard, poses);
  EXPECT_TRUE(poses.empty());
}

// A covered side: its corners lie further in, on the lines of the sides beside it.
TEST(CardHypotheses, ThreeSidesTellTheFourth) {
  std::mt19937 random(test::random_seed());
  std::uniform_real_distribution<double> covered(0.1, 0.5);
  for (int round = 0; round < 100; ++round) {
    const CardOutline truth = outline_seen(random_card_view(random));
    const auto hidden = static_cast<std::size_t>(round % 4);
    CardOutline seen = truth;
    for (const auto& [own, beside] :
         {std::pair(hidden, (hidden + 3) % 4), std::pair((hidden + 1) % 4, (hidden + 2) % 4)})
      seen.corners[own] += covered(random) * (truth.corners[beside] - truth.corners[own]);
    const bool is_wide = hidden % 2 == 0;  // sides 0 and 2 are as long as the print is wide
    const double opposite_mm = is_wide ? kPosedCard.width_mm : kPosedCard.height_mm;
    const double beside_mm = is_wide ? kPosedCard.height_mm : kPosedCard.width_mm;
    CardOutline completed;
    ASSERT_TRUE(complete_outline(seen, hidden, opposite_mm, beside_mm, completed));
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_LT((completed.corners[i] - truth.corners[i]).norm() * 1400.0, 0.05) << round << " " << i;
  }
}

}  // namespace
}  // namespace traygauge
