// Food beside the dish, by outlines that were given: a textured solid on the synthetic tray.
#include "core/pipeline/tray_food.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "tests/core/pipeline/measuring_bench.hpp"

namespace traygauge {
namespace {

constexpr std::uint8_t kSolidLabel = 2;

TrayScene scene_with_solid_at(const Vec2& centre_mm, double radius_mm = 30.0) {
  TrayOptions options;
  options.solid_radius_mm = radius_mm;
  options.solid_centre_mm = centre_mm;
  return TrayScene(options);
}

const Measurement& measure(const TrayScene& scene) {
  static std::unique_ptr<MeasuringBench> bench;
  bench = std::make_unique<MeasuringBench>(scene.configuration<Configuration>());
  return bench->measure(scene);
}

TEST(TrayFood, IsMeasuredOverTheTray) {
  for (const Vec2& centre_mm : {Vec2(115.0, 0.0), Vec2(100.0, 70.0), Vec2(-60.0, -95.0)}) {
    const TrayScene scene = scene_with_solid_at(centre_mm);
    const Measurement& measurement = measure(scene);
    ASSERT_EQ(measurement.status.code(), StatusCode::ok) << centre_mm.transpose();
    ASSERT_EQ(measurement.items.size(), 1U);
    const ItemResult& item = measurement.items.front();
    EXPECT_EQ(item.label, kSolidLabel);
    EXPECT_EQ(item.dish, kFirstTrayPlace);
    EXPECT_NEAR(item.volume_ml, scene.volume_ml(), 0.03 * scene.volume_ml()) << centre_mm.transpose();
    EXPECT_LT(std::abs(item.volume_ml - scene.volume_ml()), 3.0 * item.sigma_ml) << centre_mm.transpose();
    EXPECT_TRUE(measurement.warnings.holds(Warning::item_beside_dishes, kSolidLabel));
  }
}

TEST(TrayFood, OnTheDishIsNone) {
  const TrayScene scene = scene_with_solid_at(Vec2(20.0, 10.0));
  const Measurement& measurement = measure(scene);
  ASSERT_EQ(measurement.items.size(), 1U);
  EXPECT_EQ(measurement.items.front().dish, kDishLabel);
  EXPECT_FALSE(measurement.warnings.holds(Warning::item_beside_dishes));
}

// Like a pizza that leaves a crescent of its plate, and most of whose border is along the tray.
TEST(TrayFood, ThatCoversADishLiesOnIt) {
  const TrayScene scene = scene_with_solid_at(Vec2(40.0, 0.0), 85.0);
  const Measurement& measurement = measure(scene);
  ASSERT_EQ(measurement.items.size(), 1U);
  EXPECT_EQ(measurement.items.front().dish, kDishLabel);
  EXPECT_FALSE(measurement.warnings.holds(Warning::item_beside_dishes));
}

// As many pieces as there are places and one more, each a square on the bare tray of both pictures.
TEST(TrayFood, ThatIsNotMeasuredIsRefusedByName) {
  TrayScene scene = scene_with_solid_at(Vec2(20.0, 10.0));
  constexpr int kPieces = static_cast<int>(kMaxTrayPlaces) + 1;
  for (std::size_t v = 0; v < 2; ++v) {
    for (int piece = 0; piece < kPieces; ++piece) {
      const Vec3 at(-170.0 + 58.0 * piece, piece % 2 == 0 ? 125.0 : -125.0, 0.0);
      const Vec2 pixel = scene.cameras[v].project(at);
      for (int y = -6; y <= 6; ++y) {
        for (int x = -6; x <= 6; ++x) {
          const auto column = static_cast<std::size_t>(pixel.x() + x);
          const auto row = static_cast<std::size_t>(pixel.y() + y);
          scene.views[v].labels[row * kTrayWidthPx + column] =
              static_cast<std::uint8_t>(kSolidLabel + 1 + piece);
        }
      }
    }
  }
  const Measurement& measurement = measure(scene);
  ASSERT_EQ(measurement.items.size(), static_cast<std::size_t>(1 + kPieces));
  int refused = 0;
  for (const ItemResult& item : measurement.items)
    refused += item.status == StatusCode::too_many_places ? 1 : 0;
  EXPECT_EQ(refused, 1);
}

}  // namespace
}  // namespace traygauge
