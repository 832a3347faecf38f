// Sigma's terms against what they are said to be, for cameras that are known exactly.
#include "core/volume/uncertainty.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace traygauge {
namespace {

// A disc of food under two cameras that look straight down.
class Disc {
 public:
  static constexpr double kRadiusMm = 40.0;
  static constexpr double kHeightMm = 20.0;

  Disc() {
    for (std::size_t v = 0; v < 2; ++v) {
      cameras_[v].rotation = Vec3(1.0, -1.0, -1.0).asDiagonal();
      cameras_[v].translation = Vec3(v == 0 ? 0.0 : 150.0, 0.0, 500.0);
    }
    HeightVolume& food = input_.volume;
    food.area_mm2 = std::numbers::pi * kRadiusMm * kRadiusMm;
    food.mean_height_mm = food.max_height_mm = kHeightMm;
    food.volume_ml = food.column_volume_ml = food.area_mm2 * kHeightMm / 1000.0;
    food.centre_mm = Vec3(0.0, 0.0, kHeightMm);
    input_.height_per_px_mm = 1.5;
    input_.px_mm = 0.5;
  }

  UncertaintyInput& input() { return input_; }
  double variance_ml2(const UncertaintyParams& params) const {
    const double sigma_ml = estimate_sigma_ml(input_, cameras_, BundleMatrix::Zero(), params);
    return sigma_ml * sigma_ml;
  }

 private:
  TableCameras cameras_;
  UncertaintyInput input_;
};

// An outline that is off by e all along moves a volume by its length times e times half its height.
TEST(Uncertainty, AnOutlineThatWasFoundIsLessSure) {
  Disc disc;
  UncertaintyParams params;
  params.found_outline_mm = 0.7;
  const double drawn_ml2 = disc.variance_ml2(params);
  disc.input().is_outline_found = true;
  const double added_ml =
      2.0 * std::numbers::pi * Disc::kRadiusMm * params.found_outline_mm * 0.5 * Disc::kHeightMm / 1000.0;
  EXPECT_NEAR(disc.variance_ml2(params) - drawn_ml2, added_ml * added_ml, 1e-9);
}

TEST(Uncertainty, WallsAddTheirAreaTimesTheirPlace) {
  Disc disc;
  UncertaintyParams params;
  params.wall_mm = 0.5;
  const double flat_ml2 = disc.variance_ml2(params);
  disc.input().volume.wall_mm2 = 3000.0;
  EXPECT_NEAR(disc.variance_ml2(params) - flat_ml2, 1.5 * 1.5, 1e-9);
}

TEST(Uncertainty, NothingHasNone) {
  Disc disc;
  disc.input().volume = {};
  EXPECT_EQ(disc.variance_ml2({}), 0.0);
}

}  // namespace
}  // namespace traygauge
