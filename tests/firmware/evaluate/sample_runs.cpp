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

std::vector<PairRuns> sample_runs(double sigma_ml) {
  const std::vector<TruthItem> items = {{2, "rice, \"brown\" <&>", "heightfield", 100.0, 100.0, {}},
                                        {3, "plum", "scan", 40.0, {}, 48.0}};
  std::vector<PairRuns> runs;
  for (const char* capture : {"set, one/a long name that no column will hold", "två"}) {
    PairRuns pair = pair_runs(capture, items);
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const double volume_ml = 95.0 + 4.0 * static_cast<double>(seed);
      pair.runs.push_back(measured_run(
          seed, 16.0,
          {{2, StatusCode::ok, volume_ml, volume_ml, sigma_ml}, {3, StatusCode::ok, 44.0, 52.0, sigma_ml}}));
    }
    pair.runs.push_back(
        measured_run(4, 16.0, {{2, StatusCode::item_hidden}, {3, StatusCode::ok, 44.0, 52.0}}));
    pair.runs.push_back(refused_run(5, StatusCode::card_not_found));
    runs.push_back(pair);
  }
  return runs;
}

Evaluation evaluate_sample(const std::vector<PairRuns>& runs) {
  ProtocolOptions options;
  options.runs = 5;
  return evaluate_runs("set", options, runs, {"tray: several dishes"});
}

}  // namespace traygauge
