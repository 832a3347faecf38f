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

// A task, and which of its capture's pairs it is.
struct Place {
  std::size_t task;
  std::size_t pair;
};

std::size_t take_least_used(std::vector<Place>& places, std::map<std::size_t, int>& uses) {
  const auto rarest = std::min_element(places.begin(), places.end(), [&](const Place& a, const Place& b) {
    return uses[a.pair] < uses[b.pair];
  });
  const Place taken = *rarest;
  places.erase(rarest);
  ++uses[taken.pair];
  return taken.task;
}

class Runner {
 public:
  explicit Runner(const RunnerOptions& options) : options_(options), cache_(options.cache) {}

  std::vector<WorkResult> run(const std::vector<Work>& works, const ShowProgress& progress) {
    std::vector<WorkResult> results(works.size());
    std::vector<std::vector<std::size_t>> places(works.size());
    for (std::size_t w = 0; w < works.size(); ++w) {
      const ProfileAbilities abilities = abilities_of(works[w].variant.profile);
      const auto tasks = spread_out(plan_tasks(works[w].set, abilities, results[w].skipped), options_.pairs);
      Variant variant = works[w].variant;
      variant.pictures = options_.pictures;
      for (const PairTask& task : tasks) places[w].push_back(plan(task, variant));
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
  std::map<std::filesystem::path, std::vector<Place>> left;  // of each capture, what was not taken yet
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    std::vector<Place>& places = left[tasks[i].folder];
    places.push_back({i, places.size()});
  }
  std::map<std::size_t, int> uses;  // of the first, second, … pair of a capture
  std::vector<std::size_t> chosen;
  while (chosen.size() < count) {
    std::vector<std::vector<Place>*> captures;
    for (auto& [folder, places] : left) {
      if (!places.empty()) captures.push_back(&places);
    }
    const std::size_t now = std::min(count - chosen.size(), captures.size());
    const bool is_first = chosen.empty();
    for (std::size_t i = 0; i < now; ++i) {
      // Neighbours have different pairs left, captures at even distances may all have the same.
      const std::size_t capture = is_first ? (2 * i + 1) * captures.size() / (2 * now) : i;
      chosen.push_back(take_least_used(*captures[capture], uses));
    }
  }
  std::sort(chosen.begin(), chosen.end());
  std::vector<PairTask> spread;
  for (const std::size_t i : chosen) spread.push_back(tasks[i]);
  return spread;
}

std::vector<WorkResult> run_works(const std::vector<Work>& works, const RunnerOptions& options,
                                  const ShowProgress& progress) {
  return Runner(options).run(works, progress);
}

}  // namespace traygauge::tables
