// How much two rows of a table differ on the food that both measured.
#pragma once

#include <optional>
#include <vector>

#include "firmware/evaluate/bootstrap.hpp"
#include "firmware/evaluate/item_series.hpp"
#include "firmware/evaluate/statistics.hpp"

namespace traygauge::tables {

struct PairedDifference {
  int items = 0;                               // that both measured
  double mape = kUndefined;                    // of the first less that of the second
  std::optional<ConfidenceInterval> interval;  // 95 %, by bootstrap over captures
};

// Height-field foods. Where the two have pairs of views in common, only these count, and of them each
// measurement (a seed of a pair) that gave both a volume; else all measurements of an item (rows of other
// angles).
PairedDifference compare(const std::vector<PairRuns>& first, const std::vector<PairRuns>& second,
                         TruthVolume truth);

}  // namespace traygauge::tables
