#include "simulator/bodies/proof_body.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "core/base/random.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

TEST(ProofBody, ThereIsOneOfEachKindFrom50To400Ml) {
  std::set<BodyKind> kinds;
  std::set<std::string_view> ids;
  double least = 1e9;
  double most = 0.0;
  for (const ProofBody& body : proof_bodies()) {
    kinds.insert(body.kind);
    ids.insert(body.id);
    const double volume_ml = body_volume_ml(body.kind, body.size_mm);
    least = std::min(least, volume_ml);
    most = std::max(most, volume_ml);
    EXPECT_EQ(find_proof_body(body.id), &body);
    // The number in its name is its volume, rounded.
    EXPECT_EQ(body.id.substr(1), std::to_string(std::lround(volume_ml)));
  }
  EXPECT_EQ(kinds.size(), 4U);
  EXPECT_EQ(ids.size(), proof_bodies().size());
  EXPECT_NEAR(least, 50.0, 1e-9);
  EXPECT_NEAR(most, 400.0, 1e-9);
  EXPECT_EQ(find_proof_body("C51"), nullptr);
}

TEST(ProofBody, VolumesAreThoseOfTheBooks) {
  EXPECT_NEAR(body_volume_ml(BodyKind::cuboid, {20.0, 30.0, 40.0}), 24.0, 1e-9);
  EXPECT_NEAR(body_volume_ml(BodyKind::pyramid, {30.0, 30.0, 40.0}), 12.0, 1e-9);
  EXPECT_NEAR(body_volume_ml(BodyKind::ridge, {30.0, 30.0, 40.0}), 18.0, 1e-9);
  // Equal circles: a cylinder; none above: a whole cone.
  EXPECT_NEAR(body_volume_ml(BodyKind::cone, {20.0, 20.0, 10.0}), std::numbers::pi, 1e-9);
  EXPECT_NEAR(body_volume_ml(BodyKind::cone, {20.0, 0.0, 30.0}), std::numbers::pi, 1e-9);
}

// Sigma by the closed form against the spread of volumes whose lengths are drawn.
TEST(ProofBody, SigmaIsTheSpreadOfVolumes) {
  Random random(test::random_seed());
  constexpr double kSigmaMm = 0.3;
  constexpr int kDraws = 20000;
  const auto normal = [&] {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - random.uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * random.uniform());
  };
  for (const ProofBody& body : proof_bodies()) {
    const double volume_ml = body_volume_ml(body.kind, body.size_mm);
    double squares = 0.0;
    for (int i = 0; i < kDraws; ++i) {
      BodySize size_mm = body.size_mm;
      for (double& length : size_mm) length += kSigmaMm * normal();
      const double off = body_volume_ml(body.kind, size_mm) - volume_ml;
      squares += off * off;
    }
    // The spread of a spread of 20,000 is 0.5 %: ten of them.
    const double spread = std::sqrt(squares / kDraws);
    EXPECT_NEAR(body_volume_sigma_ml(body.kind, body.size_mm, kSigmaMm) / spread, 1.0, 0.05) << body.id;
  }
}

}  // namespace
}  // namespace traygauge
