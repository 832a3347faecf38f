// Surfaces neither make nor lose light, and mirror where they should.
#include "simulator/render/surface_response.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>

#include "simulator/render/coat_albedo.hpp"
#include "simulator/render/ggx.hpp"

namespace traygauge {
namespace {

constexpr double kPi = std::numbers::pi;

const Eigen::Vector3f kNormal = Eigen::Vector3f(0.3F, -0.5F, 0.8F).normalized();

Eigen::Vector3f viewer_at(double angle_deg) {
  const Eigen::Matrix3f frame = ggx::frame_about(kNormal);
  const auto angle = static_cast<float>(angle_deg * kPi / 180.0);
  return (frame * Eigen::Vector3f(std::sin(angle), 0.0F, std::cos(angle))).normalized();
}

// The integral of a function of direction over the hemisphere, by the midpoint rule; even in the sine
// squared.
template <class Function>
Eigen::Vector3d over_hemisphere(const Function& function) {
  constexpr int kRings = 1500;
  constexpr int kSectors = 1500;
  const Eigen::Matrix3f frame = ggx::frame_about(kNormal);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int i = 0; i < kRings; ++i) {
    const double sine = std::sqrt((i + 0.5) / kRings);
    const double cosine = std::sqrt(1.0 - sine * sine);
    for (int j = 0; j < kSectors; ++j) {
      const double around = 2.0 * kPi * (j + 0.5) / kSectors;
      const Eigen::Vector3f local =
          Eigen::Vector3d(sine * std::cos(around), sine * std::sin(around), cosine).cast<float>();
      sum += function(Eigen::Vector3f(frame * local)).template cast<double>() / cosine;
    }
  }
  return sum * (kPi / (static_cast<double>(kRings) * kSectors));  // d(sine²)/2 · d(around) / cosine
}

struct Case {
  float coat, roughness;
  double viewer_deg;
};

class UnderEvenLight : public ::testing::TestWithParam<Case> {};

TEST_P(UnderEvenLight, AWhiteBaseUnderACoatReturnsAllLight) {
  const auto [coat, roughness, viewer_deg] = GetParam();
  const SurfaceResponse response({Eigen::Vector3f::Ones(), coat, roughness, false}, kNormal,
                                 viewer_at(viewer_deg));
  const Eigen::Vector3d base =
      over_hemisphere([&](const Eigen::Vector3f& l) { return response.base_factor(l); });
  const Eigen::Vector3d mirrored =
      over_hemisphere([&](const Eigen::Vector3f& l) { return response.coat_factor(l).factor; });
  EXPECT_NEAR((base + mirrored).x(), 1.0, 0.01);
  EXPECT_NEAR(base.x(), static_cast<double>(response.base_albedo().x()), 0.003);
  const auto cosine = static_cast<float>(std::cos(viewer_deg * kPi / 180.0));
  EXPECT_NEAR(mirrored.x(), static_cast<double>(CoatAlbedo(coat, roughness).at(cosine)), 0.006);
}

TEST_P(UnderEvenLight, MirroredRaysAreDrawnAsOftenAsTheirDensitySays) {
  const auto [coat, roughness, viewer_deg] = GetParam();
  const SurfaceResponse response({Eigen::Vector3f::Ones(), coat, roughness, false}, kNormal,
                                 viewer_at(viewer_deg));
  std::mt19937 random(7);
  std::uniform_real_distribution<float> unit(0.0F, 1.0F);
  constexpr int kDraws = 200000;
  const Eigen::Vector3f axis = viewer_at(-viewer_deg);
  const float cap = std::cos(roughness);  // about the mirrored direction
  int drawn = 0;
  int in_cap = 0;
  double weights = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const auto sample = response.sample_coat({unit(random), unit(random)});
    if (!sample) continue;
    ++drawn;
    in_cap += sample->to_light.dot(axis) > cap ? 1 : 0;
    weights += static_cast<double>(sample->weight.x());
    if (i % 1000 != 0) continue;
    const SurfaceResponse::CoatFactor again = response.coat_factor(sample->to_light);
    EXPECT_NEAR(again.density / sample->density, 1.0F, 0.01F);
    EXPECT_NEAR(again.factor.x() / (sample->weight.x() * sample->density), 1.0F, 0.01F);
  }
  const auto density = [&](const Eigen::Vector3f& l) {
    return Eigen::Vector3f::Constant(response.coat_factor(l).density);
  };
  EXPECT_NEAR(over_hemisphere(density).x(), static_cast<double>(drawn) / kDraws, 0.01);
  const auto density_in_cap = [&](const Eigen::Vector3f& l) {
    return Eigen::Vector3f(l.dot(axis) > cap ? density(l) : Eigen::Vector3f::Zero());
  };
  EXPECT_NEAR(over_hemisphere(density_in_cap).x(), static_cast<double>(in_cap) / kDraws, 0.015);
  EXPECT_NEAR(weights / kDraws,
              static_cast<double>(CoatAlbedo(coat, roughness).at(kNormal.dot(viewer_at(viewer_deg)))), 0.006);
}

INSTANTIATE_TEST_SUITE_P(Coats, UnderEvenLight,
                         ::testing::Values(Case{0.04F, 0.1F, 0.0}, Case{0.04F, 0.1F, 60.0},
                                           Case{0.04F, 0.3F, 30.0}, Case{0.04F, 0.5F, 75.0},
                                           Case{0.1F, 0.2F, 45.0}, Case{0.04F, 0.8F, 10.0}));

TEST(SurfaceResponse, WithoutCoatIsLambert) {
  const SurfaceResponse response({Eigen::Vector3f(0.2F, 0.5F, 0.9F), 0.0F, 0.5F, false}, kNormal,
                                 viewer_at(50.0));
  EXPECT_FALSE(response.has_coat());
  const Eigen::Vector3f light = viewer_at(-35.0);
  const Eigen::Vector3f expected =
      Eigen::Vector3f(0.2F, 0.5F, 0.9F) * static_cast<float>(std::cos(35.0 * kPi / 180.0) / kPi);
  EXPECT_TRUE(response.base_factor(light).isApprox(expected, 1e-5F));
  EXPECT_TRUE(response.base_factor(-light).isZero());
}

TEST(SurfaceResponse, ASmoothCoatMirrorsLikeGlass) {
  for (const double angle_deg : {0.0, 20.0, 45.0, 70.0}) {
    const SurfaceResponse response({Eigen::Vector3f::Zero(), 0.04F, 0.0F, false}, kNormal,
                                   viewer_at(angle_deg));
    const auto sample = response.sample_coat({0.3F, 0.6F});
    ASSERT_TRUE(sample);
    EXPECT_GT(sample->to_light.dot(viewer_at(-angle_deg)), std::cos(0.05F)) << angle_deg;
    // Schlick's own error to Fresnel's formula for a refractive index of 1.5 is up to 0.017 here.
    const double c = std::cos(angle_deg * kPi / 180.0);
    const double t = std::sqrt(1.0 - (1.0 - c * c) / 2.25);
    const double s_wave = (c - 1.5 * t) / (c + 1.5 * t);
    const double p_wave = (t - 1.5 * c) / (t + 1.5 * c);
    EXPECT_NEAR(static_cast<double>(sample->weight.x()), 0.5 * (s_wave * s_wave + p_wave * p_wave), 0.02)
        << angle_deg;
  }
}

TEST(SurfaceResponse, MetalMirrorsInItsColor) {
  const Eigen::Vector3f gold(1.0F, 0.77F, 0.34F);
  const SurfaceResponse response({gold, 0.04F, 0.05F, true}, kNormal, kNormal);
  EXPECT_FALSE(response.has_base());
  const auto sample = response.sample_coat({0.5F, 0.5F});
  ASSERT_TRUE(sample);
  EXPECT_TRUE(sample->weight.isApprox(gold, 0.01F)) << sample->weight.transpose();
}

TEST(SurfaceResponse, DiffuseDirectionsFollowTheCosine) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> unit(0.0F, 1.0F);
  double mean_cosine = 0.0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  constexpr int kDraws = 100000;
  for (int i = 0; i < kDraws; ++i) {
    const Eigen::Vector3f direction = cosine_direction(kNormal, {unit(random), unit(random)});
    mean_cosine += static_cast<double>(direction.dot(kNormal)) / kDraws;
    mean += direction.cast<double>() / kDraws;
  }
  EXPECT_NEAR(mean_cosine, 2.0 / 3.0, 0.004);  // ∫ cos² / π over the hemisphere
  EXPECT_LT((mean - 2.0 / 3.0 * kNormal.cast<double>()).norm(), 0.006);
}

}  // namespace
}  // namespace traygauge
