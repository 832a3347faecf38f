#include "firmware/evaluate/accuracy.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "firmware/base/percent.hpp"
#include "firmware/evaluate/statistics.hpp"

namespace traygauge {
namespace {

constexpr double kTwoSided95 = 1.96;  // of the normal distribution

std::vector<double> volumes_of(const ItemSeries& series) {
  std::vector<double> volumes;
  for (const Attempt& attempt : series.attempts) {
    if (attempt.is_measured) volumes.push_back(attempt.volume_ml);
  }
  return volumes;
}

// Equation (3); NaN for fewer than two volumes.
double variation(const std::vector<double>& volumes) {
  const double centre = mean(volumes);
  if (volumes.size() < 2 || !(centre > 0.0)) return kUndefined;
  return kPercent * population_deviation(volumes) / centre;
}

// A value a pair.
std::vector<double> variations_over_seeds(const ItemSeries& series) {
  std::map<int, std::vector<double>> by_pair;
  for (const Attempt& attempt : series.attempts) {
    if (attempt.is_measured) by_pair[attempt.pair].push_back(attempt.volume_ml);
  }
  std::vector<double> values;
  for (const auto& [pair, volumes] : by_pair) {
    const double value = variation(volumes);
    if (!std::isnan(value)) values.push_back(value);
  }
  return values;
}

template <class Condition>
double share(const std::vector<double>& values, Condition condition) {
  if (values.empty()) return kUndefined;
  const auto count = std::count_if(values.begin(), values.end(), condition);
  return kPercent * static_cast<double>(count) / static_cast<double>(values.size());
}

// What the figures over items are made of.
struct Collected {
  std::vector<double> item_mapes;
  std::vector<double> item_mapes_with_refusals;
  std::vector<double> item_cvs;
  std::vector<double> pair_cvs;
  std::vector<double> errors;  // signed, a value an estimate
  double absolute_ml = 0.0;
  double truth_ml = 0.0;
};

void collect_item(const ItemSeries& item, const ItemFigures& figures, Collected& all) {
  const double estimates = figures.estimates;
  const double attempts = estimates + figures.refused;
  if (attempts > 0.0) {
    const double sum = figures.estimates > 0 ? figures.mape * estimates : 0.0;
    all.item_mapes_with_refusals.push_back((sum + kPercent * figures.refused) / attempts);
  }
  if (figures.estimates == 0) return;
  all.item_mapes.push_back(figures.mape);
  if (!std::isnan(figures.cv)) all.item_cvs.push_back(figures.cv);
  for (const double value : variations_over_seeds(item)) all.pair_cvs.push_back(value);
  for (const double volume : volumes_of(item)) {
    all.errors.push_back(signed_error_percent(volume, item.truth_ml));
    all.absolute_ml += std::abs(volume - item.truth_ml);
    all.truth_ml += item.truth_ml;
  }
}

void describe_errors(const std::vector<double>& errors, SetFigures& figures) {
  figures.bias = mean(errors);
  const double spread = kTwoSided95 * sample_deviation(errors);
  figures.limit_low = figures.bias - spread;
  figures.limit_high = figures.bias + spread;
  figures.within_10 = share(errors, [](double error) { return std::abs(error) <= 10.0; });
  figures.within_20 = share(errors, [](double error) { return std::abs(error) <= 20.0; });
  figures.worst = *std::max_element(errors.begin(), errors.end(),
                                    [](double a, double b) { return std::abs(a) < std::abs(b); });
}

void count_large_errors(const ItemSeries& item, SetFigures& figures) {
  for (const Attempt& attempt : item.attempts) {
    if (!attempt.is_measured) continue;
    if (std::abs(signed_error_percent(attempt.volume_ml, item.truth_ml)) <= 20.0) continue;
    ++figures.beyond_20;
    if (!attempt.is_warned) ++figures.beyond_20_unwarned;
  }
}

}  // namespace

ItemFigures item_figures(const ItemSeries& series) {
  ItemFigures figures;
  const std::vector<double> volumes = volumes_of(series);
  figures.estimates = static_cast<int>(volumes.size());
  figures.refused = static_cast<int>(series.attempts.size() - volumes.size());
  if (volumes.empty()) return figures;
  std::vector<double> errors;
  std::vector<double> absolute;
  errors.reserve(volumes.size());
  absolute.reserve(volumes.size());
  for (const double volume : volumes) {
    errors.push_back(signed_error_percent(volume, series.truth_ml));
    absolute.push_back(std::abs(errors.back()));
  }
  figures.mean_ml = mean(volumes);
  figures.mape = mean(absolute);
  figures.bias = mean(errors);
  figures.cv = variation(volumes);
  figures.cv_seeds = mean(variations_over_seeds(series));
  return figures;
}

SetFigures set_figures(const std::vector<ItemSeries>& items) {
  SetFigures figures;
  Collected all;
  for (const ItemSeries& item : items) {
    const ItemFigures own = item_figures(item);
    figures.estimates += own.estimates;
    figures.refused += own.refused;
    collect_item(item, own, all);
    count_large_errors(item, figures);
  }
  figures.items = static_cast<int>(all.item_mapes.size());
  figures.items_tried = static_cast<int>(all.item_mapes_with_refusals.size());
  figures.mape_refusals_as_100 = mean(all.item_mapes_with_refusals);
  if (figures.items_tried == 0) return figures;
  figures.refused_fraction = kPercent * figures.refused / (figures.refused + figures.estimates);
  if (figures.items == 0) return figures;
  figures.mape = mean(all.item_mapes);
  figures.pmae = kPercent * all.absolute_ml / all.truth_ml;
  describe_errors(all.errors, figures);
  figures.cv = mean(all.item_cvs);
  figures.cv_below_1_5 = share(all.item_cvs, [](double cv) { return cv < 1.5; });
  figures.cv_below_10 = share(all.item_cvs, [](double cv) { return cv < 10.0; });
  figures.cv_seeds = mean(all.pair_cvs);
  return figures;
}

}  // namespace traygauge
