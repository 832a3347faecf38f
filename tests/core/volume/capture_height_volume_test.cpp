// Height maps of captures from the one view whose true depth is known: hidden cells have no second view.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "tests/core/stereo/capture_scene.hpp"
#include "tests/core/stereo/true_grid.hpp"
#include "tests/core/volume/height_measurement.hpp"

namespace traygauge {
namespace {

TEST(CaptureHeightVolume, TrueDepthOfOneViewGivesTheTrueVolumes) {
  if (test::captures_folder().empty()) GTEST_SKIP() << "TRAYGAUGE_CAPTURES is not set";
  std::vector<std::string> names = test::single_dish_captures();
  for (const char* tray : {"trays/t01", "trays/t04", "trays/t05"}) names.emplace_back(tray);
  test::HeightMeasurement measurement;
  double sum = 0.0;
  double magnitude = 0.0;
  double count = 0.0;
  for (const std::string& name : names) {
    const test::CaptureTruth capture = test::read_capture_truth(test::captures_folder() / name);
    for (const test::DishInCapture& dish : test::dishes_of(capture, name)) {
      const test::TrueGrid grid = test::true_grid(capture, dish);
      const SurfaceGrid view = grid.view();
      ASSERT_TRUE(measurement.run({&view, 1}, dish.dish).ok()) << dish.name;
      for (const test::DishItem& item : dish.items) {
        const HeightVolume& measured = measurement.item(item.label);
        const double error = measured.volume_ml / item.volume_ml - 1.0;
        const double column = measured.column_volume_ml / item.column_ml - 1.0;
        std::printf("%-16s %-12s column %+6.2f%%  closed %+6.2f%%  hidden %4.1f%%\n", dish.name.c_str(),
                    item.name.c_str(), 100 * column, 100 * error, 100 * measured.hidden_fraction);
        EXPECT_EQ(item.is_liquid, measurement.liquid.label == item.label) << item.name;
        if (item.is_liquid) {
          EXPECT_LT(std::abs(error), 0.01) << item.name;  // the outline is right to half a sample
        }
        if (item.is_scan) {
          EXPECT_LT(std::abs(column), 0.06) << item.name;
          EXPECT_LT(measured.volume_ml, 0.95 * measured.column_volume_ml) << item.name;
          continue;
        }
        EXPECT_NEAR(measured.volume_ml, measured.column_volume_ml, 1e-9) << item.name;
        sum += error;
        magnitude += std::abs(error);
        count += 1.0;
      }
    }
  }
  std::printf("bias %+.2f%%  MAPE %.2f%%\n", 100 * sum / count, 100 * magnitude / count);
  EXPECT_LT(magnitude / count, 0.01);
  EXPECT_LT(std::abs(sum / count), 0.005);
}

}  // namespace
}  // namespace traygauge
