// The protocol's runs, summed up.
#pragma once

#include <string>
#include <vector>

#include "firmware/evaluate/protocol.hpp"
#include "firmware/evaluate/statistics.hpp"

namespace traygauge {

// What an item's estimates are compared with.
enum class TruthVolume {
  above_bottom_plane,  // what a flat dish gives, as the paper assumes
  above_dish,          // above the dish's own inner surface
  column,              // under the upper surface of a scanned fruit
};

// A series for each item of `runs`; items without that kind of truth, and (unless `overhanging`) scanned
// fruit, are left out.
std::vector<ItemSeries> collect_series(const std::vector<PairRuns>& runs, TruthVolume truth,
                                       bool overhanging);

// Terminal report: a row a capture, then the whole set, then what was refused and why.
std::string compose_evaluation(const std::vector<PairRuns>& runs);

// For a spreadsheet: a row an item of each run.
std::string compose_estimates_csv(const std::vector<PairRuns>& runs);

// A row a run: how far each stage came, and how far from the truth it lies.
std::string compose_runs_csv(const std::vector<PairRuns>& runs);

}  // namespace traygauge
