#include "firmware/handover/scan_shape.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/firmware/handover/drawn_tray.hpp"

namespace traygauge::test {
namespace {

using Json = nlohmann::json;

TEST(ScanShape, HasHeightsAndLabelsOfEveryCell) {
  const DrawnTray tray;
  const Json shape = Json::parse(compose_shape(tray.measurement(), "kitchen-7"));
  EXPECT_EQ(shape["id"], "kitchen-7");
  ASSERT_EQ(shape["dishes"].size(), 1U);
  const Json& dish = shape["dishes"][0];
  EXPECT_NEAR(dish["cell_mm"].get<double>(), 3 * DrawnTray::kCellMm, 1e-9);
  const int columns = dish["columns"];
  ASSERT_EQ(columns, 67);
  ASSERT_EQ(dish["rows"], 67);
  ASSERT_EQ(dish["labels"].size(), 67U * 67U);
  const auto at = [columns](int x, int y) { return static_cast<std::size_t>(y * columns + x); };
  EXPECT_EQ(dish["surface_tenth_mm"][at(33, 33)], 325);
  EXPECT_EQ(dish["labels"][at(33, 33)], 2);
  EXPECT_EQ(dish["surface_tenth_mm"][at(33, 10)], 100);
  EXPECT_EQ(dish["labels"][at(33, 10)], 0);
  EXPECT_TRUE(dish["surface_tenth_mm"][at(0, 0)].is_null());
  EXPECT_TRUE(dish["inner_tenth_mm"][at(0, 0)].is_null());
}

TEST(ScanShape, OutlinesEachItem) {
  const DrawnTray tray;
  const Json shape = Json::parse(compose_shape(tray.measurement(), "kitchen-7"));
  ASSERT_EQ(shape["outlines"].size(), 1U);
  EXPECT_EQ(shape["outlines"][0]["label"], 2);
  EXPECT_EQ(shape["outlines"][0]["dish"], 1);
  EXPECT_GE(shape["outlines"][0]["points_mm"].size(), 8U);
}

TEST(ScanShape, OfNoSurfaceIsEmpty) {
  EXPECT_EQ(compose_shape({}, "kitchen-7"), "");
}

}  // namespace
}  // namespace traygauge::test
