// The paper's figures of merit (IV-B, equations 2 to 4) and what is reported beside them.
#pragma once

#include <string>
#include <vector>

namespace traygauge {

// All estimates of one food item, over pairs and seeds.
struct ItemSeries {
  std::string capture;
  int label = 0;
  std::string name;
  bool overhangs = false;  // a scanned fruit: reported apart
  double truth_ml = 0.0;
  std::vector<double> estimates_ml;
  int refusals = 0;  // runs that gave no volume for it
};

// Of one item; percentages. Meaningless without estimates.
struct ItemFigures {
  double mape = 0.0;  // equation (2)
  double bias = 0.0;  // mean signed error
  double cv = 0.0;    // equation (3)
};
ItemFigures item_figures(const ItemSeries& series);

// Over items; every figure but `refused` leaves refusals out, `mape_refusals_as_100` counts each as 100 %.
struct SetFigures {
  int items = 0;  // with at least one estimate
  int estimates = 0;
  int refused = 0;
  double mape = 0.0;  // equation (4)
  double mape_refusals_as_100 = 0.0;
  double pmae = 0.0;  // mean absolute error over mean truth
  double bias = 0.0;
  double limit_low = 0.0;  // 95 % limits of agreement: bias ± 1.96 standard deviations of the signed errors
  double limit_high = 0.0;
  double cv = 0.0;         // mean over items
  double within_10 = 0.0;  // share of estimates in per cent
  double within_20 = 0.0;
  double worst = 0.0;  // signed error with the largest absolute value
};
SetFigures set_figures(const std::vector<ItemSeries>& items);

// Of unordered numbers; NaN when there are none.
double median(std::vector<double> values);

}  // namespace traygauge
