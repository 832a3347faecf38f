#include "firmware/evaluate/evaluation.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "firmware/base/text.hpp"
#include "firmware/evaluate/statistics.hpp"

namespace traygauge {
namespace {

// Angle bins have the paper's angles (Table V) in their middle: commanded angles are met to half a degree
// only.
constexpr double kAngleBinDeg = 5.0;
constexpr double kMaxAngleDeg = 180.0;
constexpr double kAngleToleranceDeg = 0.5;
constexpr double kOptimalLowDeg = 15.0;  // paper, V-D 2
constexpr double kOptimalHighDeg = 20.0;

constexpr const char* kFoods = "foods";
constexpr const char* kAbovePlane = "foods_above_bottom_plane";
constexpr const char* kFruitClosed = "fruit_closed";

using RunRange = std::pair<const PairRuns*, const PairRuns*>;

template <class Value>
double median_error(RunRange runs, Value value) {
  std::vector<double> values;
  for (const PairRuns* pair = runs.first; pair != runs.second; ++pair) {
    for (const Run& run : pair->runs) {
      if (run.errors) values.push_back(value(*run.errors));
    }
  }
  return median(std::move(values));
}

StageFigures stage_figures(RunRange runs) {
  const auto signed_error = [&](double StageErrors::*member) {
    return median_error(runs, [&](const StageErrors& errors) { return errors.*member; });
  };
  const auto absolute = [&](double StageErrors::*member) {
    return median_error(runs, [&](const StageErrors& errors) { return std::abs(errors.*member); });
  };
  StageFigures figures;
  figures.rotation_deg = absolute(&StageErrors::rotation_deg);
  figures.direction_deg = absolute(&StageErrors::direction_deg);
  figures.scale_percent = absolute(&StageErrors::scale_percent);
  figures.bottom_tilt_deg = absolute(&StageErrors::bottom_tilt_deg);
  figures.bottom_offset_mm = signed_error(&StageErrors::bottom_offset_mm);
  figures.table_tilt_deg = absolute(&StageErrors::table_tilt_deg);
  figures.table_offset_mm = signed_error(&StageErrors::table_offset_mm);
  std::vector<double> times;
  for (const PairRuns* pair = runs.first; pair != runs.second; ++pair) {
    for (const Run& run : pair->runs) times.push_back(run.total_ms);
  }
  figures.time_ms = median(std::move(times));
  return figures;
}

GroupEvaluation evaluate_group(const std::string& key, const std::string& title,
                               std::vector<ItemSeries> items) {
  GroupEvaluation group{key, title, std::move(items), {}, {}, {}, {}, {}};
  group.figures = set_figures(group.items);
  group.sigma = sigma_figures(group.items);
  group.mape_interval = mape_interval(group.items);
  group.bias_interval = bias_interval(group.items);
  group.coverage_interval = coverage_interval(group.items);
  return group;
}

std::vector<GroupEvaluation> evaluate_groups(const std::vector<PairRuns>& runs,
                                             const ProfileAbilities& profile) {
  std::vector<GroupEvaluation> groups;
  const auto add = [&](const std::string& key, const std::string& title, TruthVolume truth,
                       bool overhanging) {
    auto items = collect_series(runs, truth, overhanging);
    if (!groups.empty() && items.empty()) return;
    groups.push_back(evaluate_group(key, title, std::move(items)));
  };
  add(kFoods, "foods", TruthVolume::above_dish, false);
  if (profile.takes_dish_for_flat)
    add(kAbovePlane, "foods, flat dish", TruthVolume::above_bottom_plane, false);
  add(kFruitClosed, "fruit, closed", TruthVolume::above_dish, true);
  add("fruit_column", "fruit, column", TruthVolume::column, true);
  return groups;
}

const GroupEvaluation* find_group(const std::vector<GroupEvaluation>& groups, const std::string& key) {
  const auto found = std::find_if(groups.begin(), groups.end(),
                                  [&](const GroupEvaluation& group) { return group.key == key; });
  return found == groups.end() ? nullptr : &*found;
}

CaptureEvaluation evaluate_capture(const std::string& capture, const std::vector<GroupEvaluation>& groups,
                                   RunRange runs) {
  CaptureEvaluation evaluation{capture, {}, {}, stage_figures(runs)};
  evaluation.foods = set_figures(select_capture(groups.front().items, capture));
  if (const GroupEvaluation* flat = find_group(groups, kAbovePlane))
    evaluation.foods_above_plane = set_figures(select_capture(flat->items, capture));
  return evaluation;
}

CaptureEvaluation evaluate_all(const std::vector<GroupEvaluation>& groups, RunRange runs) {
  CaptureEvaluation evaluation{"all", groups.front().figures, {}, stage_figures(runs)};
  if (const GroupEvaluation* flat = find_group(groups, kAbovePlane))
    evaluation.foods_above_plane = flat->figures;
  return evaluation;
}

std::vector<CaptureEvaluation> evaluate_captures(const std::vector<PairRuns>& runs,
                                                 const std::vector<GroupEvaluation>& groups) {
  std::vector<CaptureEvaluation> captures;
  const PairRuns* end = runs.data() + runs.size();
  for (const PairRuns* first = runs.data(); first != end;) {
    const auto* last =
        std::find_if(first, end, [&](const PairRuns& pair) { return pair.capture != first->capture; });
    captures.push_back(evaluate_capture(first->capture, groups, {first, last}));
    first = last;
  }
  return captures;
}

AngleEvaluation evaluate_angles(const std::string& title, const std::vector<ItemSeries>& foods,
                                double low_deg, double high_deg) {
  const std::vector<ItemSeries> items = select_angles(foods, low_deg, high_deg);
  std::set<int> pairs;
  for (const ItemSeries& item : items) {
    for (const Attempt& attempt : item.attempts) pairs.insert(attempt.pair);
  }
  return {title, low_deg, high_deg, static_cast<int>(pairs.size()), set_figures(items)};
}

std::vector<AngleEvaluation> evaluate_angle_bins(const std::vector<ItemSeries>& foods) {
  std::vector<AngleEvaluation> bins;
  constexpr int last_bin = static_cast<int>(kMaxAngleDeg / kAngleBinDeg);
  for (int i = 0; i <= last_bin; ++i) {
    const double middle = i * kAngleBinDeg;
    const double low = middle - 0.5 * kAngleBinDeg;
    const double high = middle + 0.5 * kAngleBinDeg;
    AngleEvaluation bin =
        evaluate_angles(fixed(std::max(low, 0.0), 1) + "° to " + fixed(high, 1) + "°", foods, low, high);
    if (bin.pairs > 0) bins.push_back(std::move(bin));
  }
  return bins;
}

std::vector<ItemEvaluation> evaluate_items(const std::vector<GroupEvaluation>& groups) {
  std::vector<ItemEvaluation> items;
  for (const GroupEvaluation& group : groups) {
    if (group.key != kFoods && group.key != kFruitClosed) continue;
    for (const ItemSeries& series : group.items)
      items.push_back({series, item_figures(series), sigma_figures({series})});
  }
  std::sort(items.begin(), items.end(), [](const ItemEvaluation& a, const ItemEvaluation& b) {
    return std::pair(a.series.capture, a.series.label) < std::pair(b.series.capture, b.series.label);
  });
  return items;
}

// A measurement that failed counts once, one that gave some items counts each that it did not give.
std::map<std::string, int> count_refusals(const std::vector<PairRuns>& runs) {
  std::map<std::string, int> causes;
  for (const PairRuns& pair : runs) {
    for (const Run& run : pair.runs) {
      if (run.status != StatusCode::ok && run.status != StatusCode::partial) {
        ++causes[pair.capture + ": " + name(run.status)];
        continue;
      }
      for (const TruthItem& item : pair.truth.items) {
        if (estimate_of(run, item.label) != nullptr) continue;
        ++causes[pair.capture + ": item " + std::to_string(item.label) + " " +
                 name_of_refusal(run, item.label)];
      }
    }
  }
  return causes;
}

int count_items_without_volume(const std::vector<PairRuns>& runs) {
  std::set<std::pair<std::string, int>> items;
  for (const PairRuns& pair : runs) {
    for (const TruthItem& item : pair.truth.items) {
      if (item.volume_ml <= 0.0) items.insert({pair.capture, item.label});
    }
  }
  return static_cast<int>(items.size());
}

}  // namespace

std::string name_of_refusal(const Run& run, int label) {
  for (const ItemEstimate& item : run.items) {
    if (item.label == label && item.status != StatusCode::ok) return name(item.status);
  }
  const bool has_measured = run.status == StatusCode::ok || run.status == StatusCode::partial;
  return has_measured ? "not_reported" : name(run.status);
}

Evaluation evaluate_runs(const std::string& set, const ProtocolOptions& options,
                         const std::vector<PairRuns>& runs, const std::vector<std::string>& skipped) {
  Evaluation evaluation;
  evaluation.set = set;
  evaluation.profile = options.profile.name;
  evaluation.seeds = options.runs;
  evaluation.pairs = static_cast<int>(runs.size());
  for (const PairRuns& pair : runs) evaluation.measurements += static_cast<int>(pair.runs.size());
  evaluation.groups = evaluate_groups(runs, options.profile);
  const GroupEvaluation& foods = evaluation.groups.front();
  evaluation.captures = evaluate_captures(runs, evaluation.groups);
  evaluation.all = evaluate_all(evaluation.groups, {runs.data(), runs.data() + runs.size()});
  evaluation.items = evaluate_items(evaluation.groups);
  evaluation.angles = evaluate_angle_bins(foods.items);
  AngleEvaluation optimal = evaluate_angles("15° to 20°", foods.items, kOptimalLowDeg - kAngleToleranceDeg,
                                            kOptimalHighDeg + kAngleToleranceDeg);
  if (optimal.pairs > 0) evaluation.optimal_angles = std::move(optimal);
  evaluation.refusals = count_refusals(runs);
  evaluation.items_without_volume = count_items_without_volume(runs);
  evaluation.skipped = skipped;
  evaluation.outlines = summarise_outlines(runs);
  return evaluation;
}

}  // namespace traygauge
