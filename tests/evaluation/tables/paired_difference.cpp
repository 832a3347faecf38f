#include "tests/evaluation/tables/paired_difference.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "firmware/evaluate/accuracy.hpp"

namespace traygauge::tables {
namespace {

using PairNames = std::set<std::pair<std::string, std::array<int, 2>>>;

PairNames names_of(const std::vector<PairRuns>& runs) {
  PairNames names;
  for (const PairRuns& pair : runs) names.emplace(pair.capture, pair.pair);
  return names;
}

std::vector<PairRuns> select(const std::vector<PairRuns>& runs, const PairNames& names) {
  std::vector<PairRuns> selected;
  std::copy_if(runs.begin(), runs.end(), std::back_inserter(selected), [&](const PairRuns& pair) {
    return names.count({pair.capture, pair.pair}) > 0;
  });
  return selected;
}

// Leaves the attempts that gave both a volume.
void keep_common(ItemSeries& first, ItemSeries& second) {
  std::vector<Attempt> of_first;
  std::vector<Attempt> of_second;
  for (std::size_t i = 0; i < std::min(first.attempts.size(), second.attempts.size()); ++i) {
    if (!first.attempts[i].is_measured || !second.attempts[i].is_measured) continue;
    of_first.push_back(first.attempts[i]);
    of_second.push_back(second.attempts[i]);
  }
  first.attempts = std::move(of_first);
  second.attempts = std::move(of_second);
}

PairedDifference compare_items(const std::vector<ItemSeries>& first, const std::vector<ItemSeries>& second,
                               bool is_aligned) {
  std::map<std::pair<std::string, int>, ItemSeries> others;
  for (const ItemSeries& item : second) others[{item.capture, item.label}] = item;
  std::map<std::string, RatioPart> by_capture;
  PairedDifference difference;
  RatioPart all;
  for (ItemSeries own : first) {
    const auto found = others.find({own.capture, own.label});
    if (found == others.end()) continue;
    ItemSeries other = found->second;
    if (is_aligned) keep_common(own, other);
    const ItemFigures own_figures = item_figures(own);
    const ItemFigures other_figures = item_figures(other);
    if (own_figures.estimates == 0 || other_figures.estimates == 0) continue;
    for (RatioPart* part : {&by_capture[own.capture], &all}) {
      part->numerator += own_figures.mape - other_figures.mape;
      part->denominator += 1.0;
    }
    ++difference.items;
  }
  if (difference.items == 0) return difference;
  difference.mape = all.numerator / all.denominator;
  std::vector<RatioPart> parts;
  for (const auto& [capture, part] : by_capture) parts.push_back(part);
  difference.interval = bootstrap_ratio(parts);
  return difference;
}

}  // namespace

PairedDifference compare(const std::vector<PairRuns>& first, const std::vector<PairRuns>& second,
                         TruthVolume truth) {
  const PairNames of_first = names_of(first);
  const PairNames of_second = names_of(second);
  PairNames common;
  std::set_intersection(of_first.begin(), of_first.end(), of_second.begin(), of_second.end(),
                        std::inserter(common, common.end()));
  const auto series = [&](const std::vector<PairRuns>& runs) {
    return collect_series(common.empty() ? runs : select(runs, common), truth, false);
  };
  return compare_items(series(first), series(second), !common.empty());
}

}  // namespace traygauge::tables
