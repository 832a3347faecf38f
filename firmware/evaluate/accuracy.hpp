// The paper's figures of merit (IV-B, equations 2 to 4) and what is reported beside them. All are
// percentages; what is not defined (no estimate, or a spread of one) is NaN.
#pragma once

#include <vector>

#include "firmware/evaluate/item_series.hpp"
#include "firmware/evaluate/statistics.hpp"

namespace traygauge {

// Of one item, over its pairs and seeds.
struct ItemFigures {
  int estimates = 0;
  int refused = 0;  // runs that gave no volume for it
  double mean_ml = kUndefined;
  double mape = kUndefined;      // equation (2)
  double bias = kUndefined;      // mean signed error
  double cv = kUndefined;        // equation (3), over pairs and seeds
  double cv_seeds = kUndefined;  // over the seeds of one pair, mean over pairs
};
ItemFigures item_figures(const ItemSeries& series);

// Over items. Refusals are left out of every figure but `refused` and `mape_refusals_as_100`.
struct SetFigures {
  int items = 0;        // with at least one estimate
  int items_tried = 0;  // refused ones included
  int estimates = 0;
  int refused = 0;
  double refused_fraction = kUndefined;  // of all attempts
  double mape = kUndefined;              // equation (4)
  double mape_refusals_as_100 = kUndefined;
  double pmae = kUndefined;       // mean absolute error over mean truth
  double bias = kUndefined;       // mean signed error over estimates
  double limit_low = kUndefined;  // 95 % limits of agreement: bias ± 1.96 standard deviations (n - 1)
  double limit_high = kUndefined;
  double within_10 = kUndefined;  // share of estimates
  double within_20 = kUndefined;
  double worst = kUndefined;         // signed error with the largest absolute value
  int beyond_20 = 0;                 // estimates more than 20 % off
  int beyond_20_unwarned = 0;        // of those, from runs without a warning
  double cv = kUndefined;            // mean over items with two estimates or more
  double cv_below_1_5 = kUndefined;  // share of those items
  double cv_below_10 = kUndefined;
  double cv_seeds = kUndefined;  // mean over items and pairs with two estimates or more
};
SetFigures set_figures(const std::vector<ItemSeries>& items);

}  // namespace traygauge
