#include "tests/firmware/evaluate/sample_runs.hpp"

#include <algorithm>
#include <utility>

namespace traygauge {

Attempt measured(int pair, double volume_ml, double sigma_ml) {
  Attempt attempt;
  attempt.pair = pair;
  attempt.is_measured = true;
  attempt.volume_ml = volume_ml;
  attempt.sigma_ml = sigma_ml;
  return attempt;
}

Attempt refused(int pair) {
  Attempt attempt;
  attempt.pair = pair;
  return attempt;
}

ItemSeries series(const std::string& capture, double truth_ml, std::vector<Attempt> attempts) {
  return {capture, 2, "food", false, truth_ml, std::move(attempts)};
}

PairRuns pair_runs(const std::string& capture, std::vector<TruthItem> truth) {
  PairRuns runs;
  runs.capture = capture;
  runs.pair = {0, 1};
  runs.truth.items = std::move(truth);
  return runs;
}

Run measured_run(std::uint64_t seed, double angle_deg, std::vector<ItemEstimate> items) {
  Run run;
  run.seed = seed;
  run.relative_angle_deg = angle_deg;
  const bool is_whole = std::all_of(items.begin(), items.end(),
                                    [](const ItemEstimate& item) { return item.status == StatusCode::ok; });
  run.status = is_whole ? StatusCode::ok : StatusCode::partial;
  run.items = std::move(items);
  return run;
}

Run refused_run(std::uint64_t seed, StatusCode code) {
  Run run;
  run.seed = seed;
  run.status = code;
  return run;
}

}  // namespace traygauge
