#include "firmware/evaluate/stage_analysis.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "firmware/evaluate/accuracy.hpp"
#include "firmware/evaluate/item_series.hpp"
#include "firmware/evaluate/statistics.hpp"

namespace traygauge {
namespace {

constexpr std::uint64_t kSeed = 1;

constexpr TrueStages only(TrueStage stage) {
  TrueStages stages{};
  stages[static_cast<std::size_t>(stage)] = true;
  return stages;
}

constexpr TrueStages all_stages() {
  TrueStages stages{};
  stages.fill(true);
  return stages;
}

std::string name_of(const Truth& truth, int label) {
  const auto found = std::find_if(truth.items.begin(), truth.items.end(),
                                  [&](const TruthItem& item) { return item.label == label; });
  if (found != truth.items.end()) return found->name;
  return "dish " + std::to_string(label);
}

void append(const HeightErrors& from, HeightErrors& to) {
  to.errors_mm.insert(to.errors_mm.end(), from.errors_mm.begin(), from.errors_mm.end());
  to.samples += from.samples;
  to.matched += from.matched;
}

LabelHeights summarise(const std::string& capture, int label, const std::string& name,
                       const HeightErrors& errors) {
  LabelHeights heights{capture, label, name};
  heights.matched_percent =
      errors.samples > 0 ? 100.0 * static_cast<double>(errors.matched) / static_cast<double>(errors.samples)
                         : kUndefined;
  std::vector<double> absolute = errors.errors_mm;
  std::transform(absolute.begin(), absolute.end(), absolute.begin(), [](double e) { return std::abs(e); });
  heights.median_mm = quantile(absolute, 0.5);
  heights.p95_mm = quantile(absolute, 0.95);
  heights.bias_mm = mean(errors.errors_mm);
  return heights;
}

std::vector<LabelHeights> summarise_heights(const StageRuns& runs) {
  std::map<std::pair<std::string, int>, std::pair<std::string, HeightErrors>> by_label;
  const std::vector<PairRuns>& pairs = runs.variants.front();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    for (const auto& [label, errors] : runs.heights[i]) {
      auto& [name, sum] = by_label[{pairs[i].capture, label}];
      name = name_of(pairs[i].truth, label);
      append(errors, sum);
    }
  }
  std::vector<LabelHeights> heights;
  heights.reserve(by_label.size());
  for (const auto& [key, value] : by_label)
    heights.push_back(summarise(key.first, key.second, value.first, value.second));
  return heights;
}

}  // namespace

const std::array<StageVariant, kStageVariants>& stage_variants() {
  static constexpr std::array<StageVariant, kStageVariants> variants = {{
      {"as_measured", "measured", {}},
      {"true_pose", "pose", only(TrueStage::pose)},
      {"true_scale", "scale", only(TrueStage::scale)},
      {"true_table", "table", only(TrueStage::table)},
      {"true_place", "place", only(TrueStage::place)},
      {"true_surface", "surface", only(TrueStage::surface)},
      {"all_true", "all", all_stages()},
  }};
  return variants;
}

StageRuns run_stages(const std::filesystem::path& set, const ProtocolOptions& options,
                     std::vector<std::string>& skipped, const ShowProgress& progress) {
  const std::vector<PairTask> tasks = plan_tasks(set, options.profile, skipped);
  StageRuns runs;
  for (std::vector<PairRuns>& variant : runs.variants) variant.resize(tasks.size());
  runs.heights.resize(tasks.size());
  for_each_task(
      tasks.size(), options.jobs, kStageVariants, progress, [&](std::size_t i, const StepDone& done) {
        PairRunner runner(tasks[i], options);
        const std::optional<TrueSurface> surface = TrueSurface::read(runner.capture(), runner.truth());
        for (std::size_t k = 0; k < kStageVariants; ++k) {
          PairRuns& pair = runs.variants[k][i];
          pair = runner.start();
          if (runner.pair_truth()) {
            StageSubstitution substitution(*runner.pair_truth(), runner.truth(), surface,
                                           stage_variants()[k].replaced);
            pair.runs.push_back(runner.measure(kSeed, &substitution));
            if (k == 0) runs.heights[i] = substitution.height_errors();
          }
          done();
        }
      });
  return runs;
}

StageAnalysis analyse_stages(const StageRuns& runs) {
  StageAnalysis analysis;
  analysis.heights = summarise_heights(runs);
  for (const PairRuns& pair : runs.variants.front()) {
    if (analysis.losses.empty() || analysis.losses.back().capture != pair.capture)
      analysis.losses.push_back({pair.capture});
  }
  analysis.all.capture = "all";
  for (std::size_t k = 0; k < kStageVariants; ++k) {
    const std::vector<ItemSeries> foods = collect_series(runs.variants[k], TruthVolume::above_dish, false);
    const auto fill = [&](StageLosses& losses, const SetFigures& figures) {
      losses.mape[k] = figures.mape;
      losses.bias[k] = figures.bias;
    };
    fill(analysis.all, set_figures(foods));
    for (StageLosses& losses : analysis.losses)
      fill(losses, set_figures(select_capture(foods, losses.capture)));
  }
  return analysis;
}

}  // namespace traygauge
