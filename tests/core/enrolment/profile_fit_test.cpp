// Profiles through ring heights, and ring heights of surfaces in closed form.
#include "core/enrolment/profile_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "core/base/units.hpp"
#include "tests/core/stereo/solid_scene.hpp"
#include "tests/support/allocated.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

using test::Allocated;

std::vector<InsetRing> rings_of(const DishProfile& profile) {
  std::vector<InsetRing> rings;
  for (double inset = 0.5; inset < profile.semi_axes_mm().minCoeff(); inset += 1.0) {
    rings.push_back({.inset_mm = inset,
                     .height_mm = profile.height_at_inset_mm(inset),
                     .spread_mm = 0.1,
                     .samples = 500.0,
                     .sigma_mm = 0.03,
                     .is_known = true});
  }
  return rings;
}

DishModel edge_of(const DishProfile& profile) {
  DishModel edge;
  edge.outer_size_mm = {2.0 * profile.semi_axes_mm().x(), 2.0 * profile.semi_axes_mm().y()};
  edge.rim_height_mm = profile.height_at_inset_mm(0.0);
  return edge;
}

class ProfileThroughRings : public ::testing::TestWithParam<int> {
 protected:
  ProfileThroughRings() {
    const std::array<InnerSurface, 3> dishes = {test::dinner_plate(), test::soup_bowl(), test::oval_plate()};
    profile_ = dishes.at(static_cast<std::size_t>(GetParam())).profile;
    rings_ = rings_of(profile_);
  }
  Status fit() { return fit_dish_profile(rings_, edge_of(profile_), {}, *workspace_, fitted_); }

  // The largest difference inside of the rim's rounding.
  double worst_mm() const {
    DishProfile found;
    EXPECT_TRUE(found.set(fitted_.dish).ok());
    EXPECT_TRUE(validate(fitted_.dish).ok());
    double worst = 0.0;
    for (double inset = 4.0; inset < profile_.semi_axes_mm().minCoeff(); inset += 0.25)
      worst = std::max(worst, std::abs(found.height_at_inset_mm(inset) - profile_.height_at_inset_mm(inset)));
    return worst;
  }

  DishProfile profile_;
  std::vector<InsetRing> rings_;
  Allocated<ProfileFitWorkspace> workspace_;
  FittedProfile fitted_;
};
INSTANTIATE_TEST_SUITE_P(Dishes, ProfileThroughRings, ::testing::Values(0, 1, 2));

TEST_P(ProfileThroughRings, FollowsExactHeightsInFewPoints) {
  ASSERT_TRUE(fit().ok());
  EXPECT_LT(worst_mm(), 0.5);  // where the foot's corner is rounded
  EXPECT_LT(fitted_.residual_mm, 0.1);
  EXPECT_NEAR(fitted_.dish.bottom_height_mm, profile_.bottom_height_mm(), 0.05);
  EXPECT_NEAR(fitted_.dish.rim_height_mm, profile_.crest_height_mm(), 0.7);  // a knife's edge
  EXPECT_LE(fitted_.dish.profile_size, ProfileFitParams{}.max_points);
  EXPECT_EQ(fitted_.dish.profile_points[0].inset_mm, 0.0);
}

TEST_P(ProfileThroughRings, NeverRisesInwardOfTheCrestWhateverTheNoise) {
  std::mt19937 random(test::random_seed());
  for (int round = 0; round < 100; ++round) {
    rings_ = rings_of(profile_);
    const double sigma_mm = std::uniform_real_distribution<double>(0.0, 0.3)(random);
    for (InsetRing& ring : rings_) {
      ring.sigma_mm = std::max(sigma_mm, 0.03);
      ring.height_mm += std::normal_distribution<double>(0.0, 1.0)(random) * sigma_mm;
    }
    ASSERT_TRUE(fit().ok()) << round;
    // Noise chooses the points: the bowl's corner near the rim may fall between two.
    EXPECT_LT(worst_mm(), 0.6 + 4.0 * sigma_mm) << round;
    const auto points = fitted_.dish.profile();
    std::size_t crest = 0;
    while (crest + 1 < points.size() && points[crest + 1].height_mm > points[crest].height_mm) ++crest;
    EXPECT_LT(points[crest].inset_mm, 9.0) << round;
    for (std::size_t i = crest + 1; i < points.size(); ++i) {
      EXPECT_LE(points[i].height_mm, points[i - 1].height_mm) << round;
      EXPECT_GT(points[i].inset_mm, points[i - 1].inset_mm) << round;
    }
  }
}

TEST_P(ProfileThroughRings, BridgesRingsThatAreNotKnown) {
  for (std::size_t i = 10; i < rings_.size(); i += 4) rings_[i].is_known = false;
  ASSERT_TRUE(fit().ok());
  EXPECT_LT(worst_mm(), 0.6);
  EXPECT_NEAR(fitted_.widest_gap_mm, 1.0, 1e-9);
}

TEST_P(ProfileThroughRings, ARefusalSaysHowLittleIsKnown) {
  for (std::size_t i = 0; i < rings_.size(); ++i) rings_[i].is_known = i % 3 == 0;
  EXPECT_EQ(fit().code(), StatusCode::too_little_depth);
  EXPECT_NEAR(fitted_.known_fraction, 1.0 / 3.0, 0.02);

  rings_ = rings_of(profile_);
  for (std::size_t i = 20; i < 40; ++i) rings_[i].is_known = false;  // the wall
  EXPECT_EQ(fit().code(), StatusCode::too_little_depth);
  EXPECT_NEAR(fitted_.widest_gap_mm, 20.0, 1e-9);

  rings_ = rings_of(profile_);
  for (std::size_t i = 68 * rings_.size() / 100; i < rings_.size(); ++i)
    rings_[i].is_known = false;  // the bottom
  EXPECT_EQ(fit().code(), StatusCode::too_little_depth);
  EXPECT_NEAR(fitted_.known_fraction, 0.68, 0.02);

  rings_ = rings_of(profile_);
  for (std::size_t i = 0; i < rings_.size(); ++i) rings_[i].height_mm += i % 2 == 0 ? 1.5 : -1.5;
  EXPECT_EQ(fit().code(), StatusCode::too_little_depth);
  EXPECT_GT(fitted_.residual_mm, 1.0);

  rings_.clear();
  EXPECT_EQ(fit().code(), StatusCode::too_little_depth);
}

// A bare dish seen from one side, with a pattern that both pictures show the same way.
class RingsOfADish : public ::testing::Test {
 protected:
  RingsOfADish() {
    scene_.dish = test::soup_bowl();
    scene_.dish.place.centre_mm = {12.0, -7.0};
    grid_ = test::cast_grid(scene_, {.tilt_deg = 12.0}, {}, 60'000);
    gray_.resize(grid_.count());
    std::mt19937 random(1);
    for (std::uint8_t& gray : gray_) gray = static_cast<std::uint8_t>(100 + random() % 41);
    disparity_.assign(grid_.count(), 0.0F);
  }
  Status collect() {
    const ImageView<const std::uint8_t> gray{gray_.data(), grid_.width, grid_.height};
    const InsetView view{grid_.view(), gray, gray, {disparity_.data(), grid_.width, grid_.height}, 1};
    InnerSurface edge = scene_.dish;
    DishModel funnel = edge_of(edge.profile);
    funnel.profile_size = 2;
    funnel.profile_points[1] = {0.49 * funnel.outer_size_mm[0], 0.0};
    EXPECT_TRUE(edge.profile.set(funnel).ok());
    return collect_inset_heights({view, InsetView{}}, edge, {}, *workspace_, rings_);
  }
  int known_rings() const {
    return static_cast<int>(
        std::count_if(rings_.begin(), rings_.end(), [](const InsetRing& ring) { return ring.is_known; }));
  }

  test::SolidScene scene_;
  test::TrueGrid grid_;
  std::vector<std::uint8_t> gray_;
  std::vector<float> disparity_;
  Allocated<InsetHeightWorkspace> workspace_{std::size_t{1} << 17U};
  std::span<const InsetRing> rings_;
};

TEST_F(RingsOfADish, MediansAreTheProfile) {
  ASSERT_TRUE(collect().ok());
  ASSERT_EQ(rings_.size(), 76U);
  EXPECT_GT(known_rings(), 65);
  for (const InsetRing& ring : rings_) {
    if (!ring.is_known || ring.inset_mm < 1.0) continue;
    // A ring is 1 mm wide: on a straight wall its median is the middle's height.
    EXPECT_NEAR(ring.height_mm, scene_.dish.profile.height_at_inset_mm(ring.inset_mm), 0.15) << ring.inset_mm;
  }
}

TEST_F(RingsOfADish, NeitherPlainNorBurntNorUnmatchedSamplesTellAHeight) {
  std::fill(gray_.begin(), gray_.end(), std::uint8_t{120});
  ASSERT_TRUE(collect().ok());
  EXPECT_EQ(known_rings(), 0);

  std::mt19937 random(2);
  for (std::uint8_t& gray : gray_) gray = random() % 2 == 0 ? kBurntGray : std::uint8_t{255};
  ASSERT_TRUE(collect().ok());
  EXPECT_EQ(known_rings(), 0);

  for (std::uint8_t& gray : gray_) gray = static_cast<std::uint8_t>(100 + random() % 41);
  std::fill(grid_.evidence.begin(), grid_.evidence.end(), SurfaceEvidence::single);
  ASSERT_TRUE(collect().ok());
  EXPECT_EQ(known_rings(), 0);
}

TEST_F(RingsOfADish, WhatOnlyOnePictureShowsIsNoPattern) {
  std::fill(disparity_.begin(), disparity_.end(), 7.0F);  // the partners show other noise
  ASSERT_TRUE(collect().ok());
  EXPECT_LT(known_rings(), 12);
}

TEST_F(RingsOfADish, SomethingInTheDishDoesNotCount) {
  // Over a third of the azimuth something stands 20 mm high.
  for (std::size_t i = 0; i < grid_.count(); ++i) {
    const Vec2 at = scene_.dish.to_dish(Vec2(grid_.points[i].x_mm, grid_.points[i].y_mm));
    if (grid_.labels[i] != 1 || at.norm() > 60.0 || std::abs(std::atan2(at.y(), at.x())) > 1.0) continue;
    grid_.labels[i] = 2;
    grid_.points[i].z_mm += 20.0F;
  }
  ASSERT_TRUE(collect().ok());
  for (const InsetRing& ring : rings_) {
    if (!ring.is_known || ring.inset_mm < 1.0) continue;
    EXPECT_NEAR(ring.height_mm, scene_.dish.profile.height_at_inset_mm(ring.inset_mm), 0.15) << ring.inset_mm;
  }
}

TEST_F(RingsOfADish, MoreThanTheMemoryHoldsIsRefused) {
  Allocated<InsetHeightWorkspace> small{std::size_t{1000}};
  std::swap(*workspace_, *small);
  EXPECT_EQ(collect().code(), StatusCode::invalid_configuration);
  std::swap(*workspace_, *small);
}

}  // namespace
}  // namespace traygauge
