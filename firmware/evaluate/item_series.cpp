#include "firmware/evaluate/item_series.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace traygauge {
namespace {

std::optional<double> true_volume(const TruthItem& item, TruthVolume kind) {
  if (kind == TruthVolume::above_bottom_plane) return item.volume_above_bottom_plane_ml;
  if (kind == TruthVolume::column) return item.column_volume_ml;
  return item.volume_ml;
}

double angle_of(const PairRuns& pair, const Run& run) {
  if (pair.true_angle_deg) return *pair.true_angle_deg;
  const bool is_measured = run.status == StatusCode::ok || run.status == StatusCode::partial;
  return is_measured ? run.relative_angle_deg : std::numeric_limits<double>::quiet_NaN();
}

Attempt attempt_of(const PairRuns& pair, int index, const Run& run, int label, TruthVolume kind) {
  Attempt attempt{index, angle_of(pair, run)};
  const ItemEstimate* estimate = estimate_of(run, label);
  if (estimate == nullptr) return attempt;
  attempt.is_measured = true;
  attempt.volume_ml = kind == TruthVolume::column ? estimate->column_volume_ml : estimate->volume_ml;
  if (kind == TruthVolume::above_dish) attempt.sigma_ml = estimate->sigma_ml;
  attempt.is_warned = is_warned(run);
  return attempt;
}

}  // namespace

std::vector<ItemSeries> collect_series(const std::vector<PairRuns>& runs, TruthVolume truth,
                                       bool overhanging) {
  std::map<std::pair<std::string, int>, ItemSeries> series;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    for (const TruthItem& item : runs[i].truth.items) {
      const auto volume = true_volume(item, truth);
      const bool overhangs = item.kind == "scan";
      if (!volume || *volume <= 0.0 || overhangs != overhanging) continue;
      ItemSeries& own = series[{runs[i].capture, item.label}];
      own.capture = runs[i].capture;
      own.label = item.label;
      own.name = item.name;
      own.overhangs = overhangs;
      own.truth_ml = *volume;
      for (const Run& run : runs[i].runs)
        own.attempts.push_back(attempt_of(runs[i], static_cast<int>(i), run, item.label, truth));
    }
  }
  std::vector<ItemSeries> list;
  list.reserve(series.size());
  for (auto& [key, own] : series) list.push_back(std::move(own));
  return list;
}

std::vector<ItemSeries> select_angles(const std::vector<ItemSeries>& items, double low_deg, double high_deg) {
  std::vector<ItemSeries> selected;
  for (const ItemSeries& item : items) {
    ItemSeries own = item;
    std::erase_if(own.attempts, [&](const Attempt& attempt) {
      return !(attempt.angle_deg >= low_deg && attempt.angle_deg < high_deg);
    });
    if (!own.attempts.empty()) selected.push_back(std::move(own));
  }
  return selected;
}

std::vector<ItemSeries> select_capture(const std::vector<ItemSeries>& items, const std::string& capture) {
  std::vector<ItemSeries> selected;
  std::copy_if(items.begin(), items.end(), std::back_inserter(selected),
               [&](const ItemSeries& item) { return item.capture == capture; });
  return selected;
}

double signed_error_percent(double estimate_ml, double truth_ml) {
  return 100.0 * (estimate_ml - truth_ml) / truth_ml;
}

}  // namespace traygauge
