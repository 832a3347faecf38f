// Runs made by hand, for figures that can be worked out on paper.
#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "firmware/evaluate/evaluation.hpp"
#include "firmware/evaluate/item_series.hpp"

namespace traygauge {

Attempt measured(int pair, double volume_ml, double sigma_ml = 0.0);
Attempt refused(int pair);

ItemSeries series(const std::string& capture, double truth_ml, std::vector<Attempt> attempts);

// A pair of a capture with items labelled 2, 3, …; poses unknown.
PairRuns pair_runs(const std::string& capture, std::vector<TruthItem> truth);

// A run that gave these items.
Run measured_run(std::uint64_t seed, double angle_deg, std::vector<ItemEstimate> items);
Run refused_run(std::uint64_t seed, StatusCode code);

// Two captures with awkward names, a pair of five seeds each: foods of 99, 103 and 107 ml (true: 100) and two
// refusals; a scanned fruit of 44 ml (true: 40), four times. Sigma on most volumes when `sigma_ml` > 0.
std::vector<PairRuns> sample_runs(double sigma_ml);

// By profile best, one capture skipped.
Evaluation evaluate_sample(const std::vector<PairRuns>& runs);

}  // namespace traygauge
