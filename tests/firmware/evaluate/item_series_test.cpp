// Runs sorted by item: which truth, which angle, what counts as refused.
#include "firmware/evaluate/item_series.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/firmware/evaluate/sample_runs.hpp"

namespace traygauge {
namespace {

TruthItem food(int label, double volume_ml) {
  return {label, "food", "heightfield", volume_ml, volume_ml + 1.0, {}};
}

TruthItem fruit(int label, double volume_ml, double column_ml) {
  return {label, "plum", "scan", volume_ml, {}, column_ml};
}

std::vector<PairRuns> sample() {
  PairRuns first = pair_runs("a", {food(2, 100.0), fruit(3, 40.0, 48.0)});
  first.runs = {
      measured_run(1, 15.0, {{2, StatusCode::ok, 90.0, 90.0, 3.0}, {3, StatusCode::ok, 41.0, 47.0, 2.0}}),
      measured_run(2, 15.0, {{2, StatusCode::ok, 91.0, 91.0, 3.0}, {3, StatusCode::item_hidden}}),
      refused_run(3, StatusCode::card_not_found)};
  PairRuns second = pair_runs("a", first.truth.items);
  second.true_angle_deg = 20.0;
  second.runs = {refused_run(1, StatusCode::views_too_close)};
  return {first, second};
}

TEST(ItemSeries, FoodsAndFruitStandApart) {
  const auto foods = collect_series(sample(), TruthVolume::above_dish, false);
  ASSERT_EQ(foods.size(), 1U);
  EXPECT_EQ(foods[0].truth_ml, 100.0);
  ASSERT_EQ(foods[0].attempts.size(), 4U);
  EXPECT_EQ(foods[0].attempts[1].volume_ml, 91.0);
  EXPECT_EQ(foods[0].attempts[1].sigma_ml, 3.0);
  EXPECT_FALSE(foods[0].attempts[2].is_measured);
  EXPECT_EQ(foods[0].attempts[3].pair, 1);
  const auto flat = collect_series(sample(), TruthVolume::above_bottom_plane, false);
  EXPECT_EQ(flat.at(0).truth_ml, 101.0);
  EXPECT_EQ(flat.at(0).attempts[0].sigma_ml, 0.0) << "sigma is of volume_ml";
}

TEST(ItemSeries, FruitHasTwoVolumes) {
  const auto closed = collect_series(sample(), TruthVolume::above_dish, true);
  const auto column = collect_series(sample(), TruthVolume::column, true);
  ASSERT_EQ(closed.size(), 1U);
  ASSERT_EQ(column.size(), 1U);
  EXPECT_EQ(closed[0].truth_ml, 40.0);
  EXPECT_EQ(closed[0].attempts[0].volume_ml, 41.0);
  EXPECT_EQ(column[0].truth_ml, 48.0);
  EXPECT_EQ(column[0].attempts[0].volume_ml, 47.0);
  EXPECT_FALSE(closed[0].attempts[1].is_measured) << "hidden";
}

TEST(ItemSeries, AnglesByTruthElseAsMeasured) {
  const auto foods = collect_series(sample(), TruthVolume::above_dish, false);
  EXPECT_EQ(foods[0].attempts[0].angle_deg, 15.0);
  EXPECT_TRUE(std::isnan(foods[0].attempts[2].angle_deg));
  EXPECT_EQ(foods[0].attempts[3].angle_deg, 20.0) << "refused, but the truth knows";
}

TEST(ItemSeries, SelectsAnglesFromLowUpToHigh) {
  const auto foods = collect_series(sample(), TruthVolume::above_dish, false);
  EXPECT_EQ(select_angles(foods, 15.0, 20.0).at(0).attempts.size(), 2U);
  EXPECT_EQ(select_angles(foods, 15.1, 25.0).at(0).attempts.size(), 1U);
  EXPECT_TRUE(select_angles(foods, 30.0, 35.0).empty());
}

TEST(ItemSeries, ItemsWithoutVolumeHaveNoPercentage) {
  PairRuns runs = pair_runs("a", {food(2, 0.0), food(3, 10.0)});
  runs.runs = {measured_run(1, 15.0, {{2, StatusCode::ok, 1.0}, {3, StatusCode::ok, 11.0}})};
  const auto foods = collect_series({runs}, TruthVolume::above_dish, false);
  ASSERT_EQ(foods.size(), 1U);
  EXPECT_EQ(foods[0].label, 3);
}

TEST(ItemSeries, TheAngleOfPosesIsThatAtTheDish) {
  // Two cameras over the dish's bottom, 400 mm away, 20 degrees from each other.
  PairTruth truth;
  truth.bottom_height_mm = 5.0;
  const double angle = 20.0 / 180.0 * std::acos(-1.0);
  truth.first_from_world.translation = -Vec3(0.0, 0.0, 405.0);
  truth.second_from_world.translation = -Vec3(400.0 * std::sin(angle), 0.0, 5.0 + 400.0 * std::cos(angle));
  EXPECT_NEAR(truth.relative_angle_deg(), 20.0, 1e-9);
}

}  // namespace
}  // namespace traygauge
