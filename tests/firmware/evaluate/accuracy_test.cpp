// The figures of merit against values worked out by hand.
#include "firmware/evaluate/accuracy.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/firmware/evaluate/sample_runs.hpp"

namespace traygauge {
namespace {

// Errors -10, +10, +20 % and one refusal.
ItemSeries spread_item() {
  return series("a", 100.0, {measured(0, 90.0), measured(0, 110.0), measured(1, 120.0), refused(1)});
}

TEST(Accuracy, OfOneItem) {
  const ItemFigures figures = item_figures(spread_item());
  EXPECT_EQ(figures.estimates, 3);
  EXPECT_EQ(figures.refused, 1);
  EXPECT_NEAR(figures.mean_ml, 320.0 / 3.0, 1e-12);
  EXPECT_NEAR(figures.mape, 40.0 / 3.0, 1e-12);
  EXPECT_NEAR(figures.bias, 20.0 / 3.0, 1e-12);
  EXPECT_NEAR(figures.cv, 100.0 * std::sqrt(1400.0 / 9.0) / (320.0 / 3.0), 1e-12);
  EXPECT_NEAR(figures.cv_seeds, 10.0, 1e-12);  // of pair 0; pair 1 has one volume
}

TEST(Accuracy, OverItems) {
  const SetFigures figures =
      set_figures({spread_item(), series("b", 50.0, {measured(2, 50.0), measured(2, 50.0)}),
                   series("c", 70.0, {refused(3), refused(3)})});
  EXPECT_EQ(figures.items, 2);
  EXPECT_EQ(figures.items_tried, 3);
  EXPECT_EQ(figures.estimates, 5);
  EXPECT_EQ(figures.refused, 3);
  EXPECT_NEAR(figures.refused_fraction, 37.5, 1e-12);
  EXPECT_NEAR(figures.mape, 20.0 / 3.0, 1e-12);
  EXPECT_NEAR(figures.mape_refusals_as_100, (35.0 + 0.0 + 100.0) / 3.0, 1e-12);
  EXPECT_NEAR(figures.pmae, 10.0, 1e-12);  // 40 of 400 ml
  EXPECT_NEAR(figures.bias, 4.0, 1e-12);
  EXPECT_NEAR(figures.limit_low, 4.0 - 1.96 * std::sqrt(130.0), 1e-12);
  EXPECT_NEAR(figures.limit_high, 4.0 + 1.96 * std::sqrt(130.0), 1e-12);
  EXPECT_NEAR(figures.within_10, 80.0, 1e-12);
  EXPECT_NEAR(figures.within_20, 100.0, 1e-12);
  EXPECT_NEAR(figures.worst, 20.0, 1e-12);
  EXPECT_EQ(figures.beyond_20, 0);
  EXPECT_NEAR(figures.cv, 0.5 * item_figures(spread_item()).cv, 1e-12);
  EXPECT_NEAR(figures.cv_below_1_5, 50.0, 1e-12);
  EXPECT_NEAR(figures.cv_below_10, 50.0, 1e-12);
  EXPECT_NEAR(figures.cv_seeds, 5.0, 1e-12);
}

TEST(Accuracy, EveryItemWeighsTheSameInMape) {
  const SetFigures figures =
      set_figures({series("a", 100.0, {measured(0, 110.0), measured(0, 110.0), measured(0, 110.0)}),
                   series("b", 100.0, {measured(1, 100.0)})});
  EXPECT_NEAR(figures.mape, 5.0, 1e-12);
  EXPECT_NEAR(figures.bias, 7.5, 1e-12);  // the mean over volumes
}

TEST(Accuracy, LargeErrorsAreWarnedOfOrNot) {
  Attempt warned = measured(0, 130.0);
  warned.is_warned = true;
  const SetFigures figures =
      set_figures({series("a", 100.0, {warned, measured(0, 75.0), measured(0, 80.0)})});
  EXPECT_EQ(figures.beyond_20, 2);
  EXPECT_EQ(figures.beyond_20_unwarned, 1);
  EXPECT_NEAR(figures.worst, 30.0, 1e-12);
}

TEST(Accuracy, NothingIsInventedWithoutVolumes) {
  for (const SetFigures& figures : {set_figures({}), set_figures({series("a", 10.0, {refused(0)})})}) {
    EXPECT_EQ(figures.items, 0);
    for (const double value : {figures.mape, figures.pmae, figures.bias, figures.limit_low, figures.within_10,
                               figures.worst, figures.cv, figures.cv_below_10, figures.cv_seeds}) {
      EXPECT_TRUE(std::isnan(value));
    }
  }
  EXPECT_TRUE(std::isnan(set_figures({}).mape_refusals_as_100));
  EXPECT_EQ(set_figures({series("a", 10.0, {refused(0)})}).mape_refusals_as_100, 100.0);
}

TEST(Accuracy, OneVolumeHasNoSpread) {
  const SetFigures figures = set_figures({series("a", 100.0, {measured(0, 101.0)})});
  EXPECT_NEAR(figures.mape, 1.0, 1e-12);
  EXPECT_TRUE(std::isnan(figures.cv));
  EXPECT_TRUE(std::isnan(figures.cv_seeds));
  EXPECT_TRUE(std::isnan(figures.limit_low));
}

TEST(Accuracy, VolumesOfZeroHaveNoVariation) {
  const ItemFigures figures = item_figures(series("a", 100.0, {measured(0, 0.0), measured(0, 0.0)}));
  EXPECT_NEAR(figures.mape, 100.0, 1e-12);
  EXPECT_TRUE(std::isnan(figures.cv));
}

}  // namespace
}  // namespace traygauge
