#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/paper/paper_bench.hpp"
#include "tests/support/cameras.hpp"

namespace traygauge::paper {
namespace {

using test::direction_error_deg;
using test::rotation_error_deg;

// Closed form: cos² hill of 40 ml, cameras 18 degrees apart.
TEST(SyntheticTray, PoseScaleAndVolumeAreRight) {
  const TrayScene& scene = default_tray();
  MeasuringBench bench(configuration_of(scene));
  const Measurement& measurement = bench.measure(scene);
  ASSERT_TRUE(measurement.status.ok()) << name(measurement.status.code());
  const Pose truth = scene.second_from_first();
  EXPECT_LT(rotation_error_deg(measurement.second_from_first, truth), 0.1);
  EXPECT_LT(direction_error_deg(measurement.second_from_first, truth), 0.3);
  EXPECT_NEAR(measurement.second_from_first.translation.norm() / truth.translation.norm(), 1.0, 0.005);
  EXPECT_NEAR(measurement.relative_angle_deg, 18.0, 1.0);
  EXPECT_NEAR(measurement.report.rim_height_mm, 0.0, 0.5);
  ASSERT_EQ(measurement.items.size(), 1U);
  EXPECT_NEAR(measurement.items[0].volume_ml, scene.volume_ml(), 0.04 * scene.volume_ml());
}

TEST(ViewOrder, ReversedPairMeasuresTheSame) {
  const TrayScene& scene = default_tray();
  MeasuringBench bench(configuration_of(scene));
  const Measurement forward = bench.measure(scene.view(0), scene.view(1));
  ASSERT_TRUE(forward.status.ok());
  const ItemResult item = forward.items[0];
  const Measurement& reverse = bench.measure(scene.view(1), scene.view(0));
  ASSERT_TRUE(reverse.status.ok());
  EXPECT_EQ(reverse.items[0].volume_ml, item.volume_ml);
  EXPECT_EQ(reverse.items[0].area_mm2, item.area_mm2);
  EXPECT_EQ(reverse.views.reference_view, 1 - forward.views.reference_view);
  EXPECT_LT(rotation_error_deg(reverse.second_from_first, forward.second_from_first.inverse()), 1e-6);
  EXPECT_LT((reverse.second_from_first.translation - forward.second_from_first.inverse().translation).norm(),
            1e-9);
}

TEST(ViewOrder, TheSteeperViewIsTheReferenceWhereverItComes) {
  const TrayScene& scene = default_tray();
  MeasuringBench bench(configuration_of(scene));
  EXPECT_EQ(bench.measure(scene.view(0), scene.view(1)).views.reference_view, 0);
  EXPECT_EQ(bench.measure(scene.view(1), scene.view(0)).views.reference_view, 1);
}

}  // namespace
}  // namespace traygauge::paper
