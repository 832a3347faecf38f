// Bootstrap intervals (Efron and Tibshirani 1993, 13.3: percentiles) over captures, because the items, pairs
// and seeds of one capture share its dish, pictures and card and are no independent draws.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "firmware/evaluate/item_series.hpp"

namespace traygauge {

struct BootstrapParams {
  int resamples = 2000;    // the percentiles are then sure to a few per cent of the interval's width
  std::uint64_t seed = 1;  // fixed: the same runs give the same interval
  double level = 0.95;
};

struct ConfidenceInterval {
  double low = 0.0;
  double high = 0.0;
};

// A capture's part of a figure that is a ratio of sums: errors over estimates, covered over all.
struct RatioPart {
  double numerator = 0.0;
  double denominator = 0.0;
};

// Of sum(numerator) / sum(denominator), parts with denominator 0 left out. Nothing for fewer than two parts.
std::optional<ConfidenceInterval> bootstrap_ratio(const std::vector<RatioPart>& parts,
                                                  const BootstrapParams& params = {});

// Of set_figures() and sigma_figures().
std::optional<ConfidenceInterval> mape_interval(const std::vector<ItemSeries>& items,
                                                const BootstrapParams& params = {});
std::optional<ConfidenceInterval> bias_interval(const std::vector<ItemSeries>& items,
                                                const BootstrapParams& params = {});
std::optional<ConfidenceInterval> coverage_interval(const std::vector<ItemSeries>& items,
                                                    const BootstrapParams& params = {});

}  // namespace traygauge
