// How thick bodies are over the samples of their pictures: ellipsoids and tubes, whose thickness is known.
#include "core/volume/body_samples.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "tests/core/stereo/true_grid.hpp"

namespace traygauge {
namespace {

constexpr std::uint8_t kBodyLabel = 9;
constexpr double kBodyStepMm = 0.5;
constexpr int kBodySide = 161;

// A camera high above looks straight down at samples of a level, `kBodyStepMm` apart; the body covers those
// within `covers`.
struct BodyScene {
  test::TrueGrid grid{kBodySide, kBodySide};
  std::vector<OutlineRow> rows = std::vector<OutlineRow>(kBodySide);
  std::vector<OutlineChord> columns = std::vector<OutlineChord>(kBodySide);

  explicit BodyScene(const std::function<bool(const Vec2&)>& covers, double level_mm = 0.0) {
    grid.camera_mm = Vec3(15.0, -20.0, 700.0);
    for (int y = 0; y < kBodySide; ++y) {
      OutlineChord chord;
      for (int x = 0; x < kBodySide; ++x) {
        const Vec2 at = place(x, y);
        const std::size_t k = grid.index(x, y);
        grid.points[k] = {static_cast<float>(at.x()), static_cast<float>(at.y()),
                          static_cast<float>(level_mm)};
        grid.evidence[k] = SurfaceEvidence::both;
        grid.labels[k] = covers(at) ? kBodyLabel : std::uint8_t{1};
        if (grid.labels[k] != kBodyLabel) continue;
        if (chord.empty()) chord.first = x;
        chord.end = x + 1;
      }
      rows[static_cast<std::size_t>(y)].chords[0] = chord;
    }
  }
  static Vec2 place(int x, int y) { return kBodyStepMm * Vec2(x - kBodySide / 2, kBodySide / 2 - y); }
  BodyPicture picture(double level_mm = 0.0) {
    return {grid.view(), 0, OutlineRows{rows, kBodySide, 0.0, kBodySide}, kBodyLabel, level_mm, columns};
  }
};

// Of the samples: how many there are, and how far their bulges are from `truth_mm2` at most.
struct BodyOff {
  int samples = 0;
  double most_mm2 = 0.0;
  double most_slope_mm = 0.0;
};

template <class Truth>
BodyOff compare_bulges(BodyScene& scene, Truth&& truth_mm2, double inside_mm2) {
  BodyOff off;
  scene.picture().for_each_sample([&](const BodySample& sample) {
    const Vec2 at = BodyScene::place(sample.x, sample.y);
    const double truth = truth_mm2(at);
    ++off.samples;
    off.most_mm2 = std::max(off.most_mm2, std::abs(sample.bulge_mm2 - truth));
    if (truth < inside_mm2) return;  // near the outline a sample is much of the distance
    constexpr double kApart = 1e-3;
    const Vec2 slope(truth_mm2(Vec2(at + Vec2(kApart, 0.0))) - truth_mm2(Vec2(at - Vec2(kApart, 0.0))),
                     truth_mm2(Vec2(at + Vec2(0.0, kApart))) - truth_mm2(Vec2(at - Vec2(0.0, kApart))));
    off.most_slope_mm = std::max(off.most_slope_mm, (sample.gradient_mm - slope / (2.0 * kApart)).norm());
  });
  return off;
}

// A squared thickness of an ellipsoid but for a constant factor: at its middle a²b² / (a² + b²).
TEST(BodySamples, OfAnEllipseAreAsAnEllipsoidIsThick) {
  constexpr double kLongMm = 33.0;
  constexpr double kShortMm = 21.0;
  const auto share = [](const Vec2& at) {
    return 1.0 - std::pow(at.x() / kLongMm, 2) - std::pow(at.y() / kShortMm, 2);
  };
  BodyScene scene([&](const Vec2& at) { return share(at) > 0.0; });
  constexpr double kMiddleMm2 =
      kLongMm * kLongMm * kShortMm * kShortMm / (kLongMm * kLongMm + kShortMm * kShortMm);
  const BodyOff off = compare_bulges(
      scene, [&](const Vec2& at) { return kMiddleMm2 * share(at); }, 0.2 * kMiddleMm2);
  const double area_mm2 = std::numbers::pi * kLongMm * kShortMm;
  EXPECT_NEAR(off.samples * scene.picture().sample_mm2(), area_mm2, 0.01 * area_mm2);
  EXPECT_LT(off.most_mm2, 0.05 * kMiddleMm2);
  EXPECT_LT(off.most_slope_mm, 0.1 * 2.0 * kMiddleMm2 / kShortMm);
}

// ρ² − r², whichever way it lies.
TEST(BodySamples, OfATubeAreWhatIsLeftOfItsRadiusSquared) {
  constexpr double kRadiusMm = 12.0;
  for (const double turn_deg : {20.0, 45.0, 70.0, 130.0}) {
    const double turn = turn_deg * std::numbers::pi / 180.0;
    const Vec2 across(-std::sin(turn), std::cos(turn));
    BodyScene scene([&](const Vec2& at) { return std::abs(across.dot(at)) < kRadiusMm; });
    int near_ends = 0;
    double most_mm2 = 0.0;
    double most_slope_mm = 0.0;
    scene.picture().for_each_sample([&](const BodySample& sample) {
      const Vec2 at = BodyScene::place(sample.x, sample.y);
      const double from_axis = across.dot(at);
      // Where the picture ends the tube's run along row or column does, too.
      const double slant = kRadiusMm / std::min(std::abs(across.x()), std::abs(across.y()));
      const double end_mm = kBodyStepMm * kBodySide / 2.0;
      if (at.cwiseAbs().maxCoeff() + 2.0 * slant > end_mm) {
        ++near_ends;
        return;
      }
      most_mm2 =
          std::max(most_mm2, std::abs(sample.bulge_mm2 - (kRadiusMm * kRadiusMm - from_axis * from_axis)));
      if (std::abs(from_axis) > 0.7 * kRadiusMm) return;
      most_slope_mm = std::max(most_slope_mm, (sample.gradient_mm + 2.0 * from_axis * across).norm());
    });
    EXPECT_LT(most_mm2, 0.08 * kRadiusMm * kRadiusMm) << turn_deg;
    EXPECT_LT(most_slope_mm, 0.15 * 2.0 * kRadiusMm) << turn_deg;
    EXPECT_GT(near_ends, 0) << turn_deg;
  }
}

// What a sample covers is said on the level: nearer to the camera it is less.
TEST(BodySamples, CoverLessOfAHigherLevel) {
  constexpr double kLevelMm = 200.0;
  BodyScene scene([](const Vec2& at) { return at.norm() < 20.0; });
  const double eye_mm = scene.grid.camera_mm.z();
  EXPECT_NEAR(scene.picture().sample_mm2(), kBodyStepMm * kBodyStepMm, 1e-4);
  EXPECT_NEAR(scene.picture(kLevelMm).sample_mm2(), std::pow(kBodyStepMm * (eye_mm - kLevelMm) / eye_mm, 2),
              1e-4);
}

TEST(BodySamples, RunAlongTheirLinesOfSight) {
  BodyScene scene([](const Vec2& at) { return at.norm() < 20.0; });
  int samples = 0;
  scene.picture().for_each_sample([&](const BodySample& sample) {
    const Vec2 foot = scene.grid.camera_mm.head<2>() + scene.grid.camera_mm.z() * sample.run;
    EXPECT_LT((foot - BodyScene::place(sample.x, sample.y)).norm(), 1e-3);
    ++samples;
  });
  EXPECT_GT(samples, 4000);
}

// Another item across a body ends its rows and columns there: it does not count as thick behind it.
TEST(BodySamples, EndWhereAnotherItemLies) {
  BodyScene scene([](const Vec2& at) { return at.norm() < 30.0 && std::abs(at.x()) > 3.0; });
  double most_mm2 = 0.0;
  double next_to_gap_mm2 = 0.0;
  scene.picture().for_each_sample([&](const BodySample& sample) {
    const Vec2 at = BodyScene::place(sample.x, sample.y);
    EXPECT_GT(std::abs(at.x()), 3.0);
    EXPECT_GT(sample.bulge_mm2, 0.0);
    most_mm2 = std::max(most_mm2, sample.bulge_mm2);
    if (std::abs(at.x()) < 3.6) next_to_gap_mm2 = std::max(next_to_gap_mm2, sample.bulge_mm2);
  });
  EXPECT_LT(next_to_gap_mm2, 0.2 * most_mm2);
}

TEST(BodySamples, OfNothingAreNone) {
  BodyScene scene([](const Vec2&) { return false; });
  int samples = 0;
  scene.picture().for_each_sample([&](const BodySample&) { ++samples; });
  EXPECT_EQ(samples, 0);
}

}  // namespace
}  // namespace traygauge
