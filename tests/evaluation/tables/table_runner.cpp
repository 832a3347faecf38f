#include "tests/evaluation/tables/table_runner.hpp"

#include <algorithm>
#include <map>

#include "simulator/capture/truth.hpp"
#include "tests/evaluation/tables/fingerprint.hpp"
#include "tests/evaluation/tables/pair_method.hpp"
#include "tests/evaluation/tables/result_cache.hpp"

namespace traygauge::tables {
namespace {

struct Planned {
  PairTask task;
  Variant variant;
  std::string key;
  std::vector<Run> runs;
};

class Runner {
 public:
  explicit Runner(const RunnerOptions& options) : options_(options), cache_(options.cache) {}

  std::vector<WorkResult> run(const std::vector<Work>& works, const ShowProgress& progress) {
    std::vector<WorkResult> results(works.size());
    std::vector<std::vector<std::size_t>> places(works.size());
    for (std::size_t w = 0; w < works.size(); ++w) {
      const ProfileAbilities abilities = abilities_of(works[w].variant.profile);
      const auto tasks = spread_out(plan_tasks(works[w].set, abilities, results[w].skipped), options_.pairs);
      for (const PairTask& task : tasks) places[w].push_back(plan(task, works[w].variant));
    }
    measure_missing(progress);
    for (std::size_t w = 0; w < works.size(); ++w) {
      for (const std::size_t place : places[w]) results[w].runs.push_back(describe_runs(planned_[place]));
    }
    return results;
  }

 private:
  // Its place among what is planned.
  std::size_t plan(const PairTask& task, const Variant& variant) {
    const std::string key = keys_.key_of(task, variant, options_.config);
    // The same pictures under two names are two captures.
    const auto [known, is_new] = places_.try_emplace(task.folder.string() + "\n" + key, planned_.size());
    if (is_new) planned_.push_back({task, variant, key, cache_.read(key)});
    return known->second;
  }

  void measure_missing(const ShowProgress& progress) {
    const auto wanted = static_cast<std::size_t>(options_.runs);
    std::vector<Planned*> missing;
    for (Planned& own : planned_) {
      if (own.runs.size() < wanted) missing.push_back(&own);
    }
    for_each_task(missing.size(), options_.jobs, wanted, progress, [&](std::size_t i, const StepDone& done) {
      Planned& own = *missing[i];
      for (std::size_t k = 0; k < own.runs.size(); ++k) done();
      const auto method = open_pair(own.task, own.variant, options_.config);
      while (own.runs.size() < wanted) {
        own.runs.push_back(method->measure(own.runs.size() + 1));
        done();
      }
      cache_.write(own.key, own.runs);
    });
  }

  PairRuns describe_runs(const Planned& own) const {
    PairRuns pair = describe_pair(own.task, read_truth(own.task.folder).value());
    pair.runs.assign(own.runs.begin(), own.runs.begin() + options_.runs);
    return pair;
  }

  const RunnerOptions& options_;
  ResultCache cache_;
  PairKeys keys_;
  std::vector<Planned> planned_;
  std::map<std::string, std::size_t> places_;
};

}  // namespace

std::vector<PairTask> spread_out(const std::vector<PairTask>& tasks, int wanted) {
  const auto count = static_cast<std::size_t>(wanted);
  if (count == 0 || count >= tasks.size()) return tasks;
  std::vector<PairTask> chosen;
  for (std::size_t i = 0; i < count; ++i) chosen.push_back(tasks[(2 * i + 1) * tasks.size() / (2 * count)]);
  return chosen;
}

std::vector<WorkResult> run_works(const std::vector<Work>& works, const RunnerOptions& options,
                                  const ShowProgress& progress) {
  return Runner(options).run(works, progress);
}

}  // namespace traygauge::tables
