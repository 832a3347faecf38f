#include "firmware/evaluate/protocol.hpp"

#include <algorithm>

#include "firmware/config/dish_choice.hpp"
#include "firmware/evaluate/true_scene.hpp"
#include "firmware/measure/measure_choices.hpp"

namespace traygauge {
namespace {

// Without the bottom, which depends on the dish.
std::optional<PairTruth> truth_of(const Truth& truth, const PairTask& task) {
  const auto first = static_cast<std::size_t>(task.pair[0]);
  const auto second = static_cast<std::size_t>(task.pair[1]);
  if (std::max(first, second) >= truth.poses.size()) return {};
  return PairTruth{pose_of(truth.poses[first]), pose_of(truth.poses[second]), 0.0};
}

Run record(const Measurement& measurement, std::uint64_t seed, std::optional<PairTruth> truth,
           const std::vector<DishDescription>& dishes) {
  Run run = record_run(measurement, seed);
  if (truth && !measurement.items.empty() && run.report.dish_index >= 0) {
    truth->bottom_height_mm = dishes.at(static_cast<std::size_t>(run.report.dish_index)).bottom_height_mm;
    run.errors = stage_errors(measurement, *truth);
  }
  return run;
}

PairRuns run_pair(const PairTask& task, const ProtocolOptions& options, const StepDone& measured) {
  PairRunner runner(task, options);
  PairRuns result = runner.start();
  for (int run = 1; run <= options.runs; ++run) {
    result.runs.push_back(runner.measure(static_cast<std::uint64_t>(run)));
    measured();
  }
  return result;
}

}  // namespace

const ItemEstimate* estimate_of(const Run& run, int label) {
  for (const ItemEstimate& item : run.items) {
    if (item.label == label && item.status == StatusCode::ok) return &item;
  }
  return nullptr;
}

bool is_warned(const Run& run) {
  return !run.warnings.empty();
}

Run record_run(const Measurement& measurement, std::uint64_t seed) {
  Run run;
  run.seed = seed;
  run.status = measurement.status.code();
  run.relative_angle_deg = measurement.relative_angle_deg;
  run.total_ms = measurement.total_ms;
  run.warnings = measurement.warnings;
  run.report = measurement.report;
  for (const ItemResult& item : measurement.items) {
    run.items.push_back({item.label, item.status, item.volume_ml, item.column_volume_ml, item.sigma_ml});
    if (item.status == StatusCode::ok) run.all_food_ml += item.volume_ml;
  }
  return run;
}

PairRuns describe_pair(const PairTask& task, const Truth& truth) {
  PairRuns runs;
  runs.capture = task.capture;
  runs.pair = task.pair;
  runs.truth = truth;
  if (const auto pair = truth_of(truth, task)) runs.true_angle_deg = pair->relative_angle_deg();
  return runs;
}

PairRunner::PairRunner(const PairTask& task, const ProtocolOptions& options)
    : task_(task),
      capture_(read_capture(task.folder)),
      truth_(read_truth(task.folder).value()),
      pair_truth_(truth_of(truth_, task)),
      dishes_(choose_dishes(capture_, options.config)),
      session_(capture_, task.pair, dishes_, options.parameters, options.labels) {
  if (session_.drawn() == nullptr) return;
  require_labels(capture_, task.pair);
  meaning_ = match_items(session_.drawn()->labels, session_.given_labels());
}

PairRuns PairRunner::start() const {
  PairRuns runs = describe_pair(task_, truth_);
  if (session_.drawn() == nullptr) return runs;
  const PairLabels& drawn = *session_.drawn();
  PairOutlines& outlines = runs.outlines.emplace();
  outlines.status = name(drawn.segmentation.status.code());
  outlines.time_ms = drawn.segmentation.total_ms();
  for (std::size_t v = 0; v < 2; ++v)
    outlines.views[v] = score_labels(drawn.labels[v], session_.given_labels()[v]);
  return runs;
}

Run PairRunner::measure(std::uint64_t seed, StageObserver* observer) {
  Run run = record(session_.measure(seed, observer), seed, pair_truth_, dishes_);
  if (session_.drawn() == nullptr) return run;
  for (ItemEstimate& item : run.items) item.label = meaning_[static_cast<std::size_t>(item.label)];
  std::erase_if(run.items, [](const ItemEstimate& item) { return item.label == 0; });
  return run;
}

std::vector<PairRuns> run_protocol(const std::filesystem::path& set, const ProtocolOptions& options,
                                   std::vector<std::string>& skipped, const ShowProgress& progress) {
  const std::vector<PairTask> tasks = plan_tasks(set, options.profile, skipped);
  std::vector<PairRuns> results(tasks.size());
  for_each_task(
      tasks.size(), options.jobs, static_cast<std::size_t>(options.runs), progress,
      [&](std::size_t i, const StepDone& measured) { results[i] = run_pair(tasks[i], options, measured); });
  return results;
}

}  // namespace traygauge
