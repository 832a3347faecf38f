#include "firmware/evaluate/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace traygauge {
namespace {

constexpr double kPercent = 100.0;
constexpr double kTwoSided95 = 1.96;  // of the normal distribution

double signed_error(double estimate_ml, double truth_ml) {
  return kPercent * (estimate_ml - truth_ml) / truth_ml;
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

// Population form, as in equation (3).
double deviation(const std::vector<double>& values) {
  const double centre = mean(values);
  double sum = 0.0;
  for (const double value : values) sum += (value - centre) * (value - centre);
  return std::sqrt(sum / static_cast<double>(values.size()));
}

double share_within(const std::vector<double>& errors, double limit) {
  const auto count =
      std::count_if(errors.begin(), errors.end(), [&](double e) { return std::abs(e) <= limit; });
  return kPercent * static_cast<double>(count) / static_cast<double>(errors.size());
}

}  // namespace

ItemFigures item_figures(const ItemSeries& series) {
  ItemFigures figures;
  if (series.estimates_ml.empty()) return figures;
  for (const double estimate : series.estimates_ml) {
    const double error = signed_error(estimate, series.truth_ml);
    figures.mape += std::abs(error);
    figures.bias += error;
  }
  const auto count = static_cast<double>(series.estimates_ml.size());
  figures.mape /= count;
  figures.bias /= count;
  figures.cv = kPercent * deviation(series.estimates_ml) / mean(series.estimates_ml);
  return figures;
}

SetFigures set_figures(const std::vector<ItemSeries>& items) {
  SetFigures figures;
  std::vector<double> errors;
  double absolute_ml = 0.0;
  double truth_ml = 0.0;
  double mape_with_refusals = 0.0;
  for (const ItemSeries& item : items) {
    figures.refused += item.refusals;
    const ItemFigures own = item_figures(item);
    const auto count = static_cast<double>(item.estimates_ml.size());
    const double runs = count + item.refusals;
    if (runs > 0.0) mape_with_refusals += (own.mape * count + kPercent * item.refusals) / runs;
    if (item.estimates_ml.empty()) continue;
    ++figures.items;
    figures.mape += own.mape;
    figures.cv += own.cv;
    for (const double estimate : item.estimates_ml) {
      errors.push_back(signed_error(estimate, item.truth_ml));
      absolute_ml += std::abs(estimate - item.truth_ml);
      truth_ml += item.truth_ml;
    }
  }
  if (!items.empty()) figures.mape_refusals_as_100 = mape_with_refusals / static_cast<double>(items.size());
  if (figures.items == 0) return figures;
  figures.estimates = static_cast<int>(errors.size());
  figures.mape /= figures.items;
  figures.cv /= figures.items;
  figures.pmae = kPercent * absolute_ml / truth_ml;
  figures.bias = mean(errors);
  const double spread = kTwoSided95 * deviation(errors);
  figures.limit_low = figures.bias - spread;
  figures.limit_high = figures.bias + spread;
  figures.within_10 = share_within(errors, 10.0);
  figures.within_20 = share_within(errors, 20.0);
  figures.worst = *std::max_element(errors.begin(), errors.end(),
                                    [](double a, double b) { return std::abs(a) < std::abs(b); });
  return figures;
}

double median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

}  // namespace traygauge
