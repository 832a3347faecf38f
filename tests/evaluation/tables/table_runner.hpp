// Measures sets by variants, and takes from the cache what was measured before.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "firmware/evaluate/pair_tasks.hpp"
#include "firmware/evaluate/protocol.hpp"
#include "tests/evaluation/tables/variant.hpp"

namespace traygauge::tables {

struct RunnerOptions {
  int runs = 8;              // seeds 1 … runs (paper: 8)
  int jobs = 1;              // pairs measured at the same time
  int pairs = 0;             // of a set, see spread_out(); 0: all
  PictureChange pictures{};  // of all sets
  std::filesystem::path cache;
  std::string config;  // folder with dishes/, for captures that name no dish; empty: the usual one
};

struct Work {
  std::filesystem::path set;
  Variant variant;
};

struct WorkResult {
  std::vector<PairRuns> runs;  // without errors of the stages
  std::vector<std::string> skipped;
};

// At most `wanted` of the tasks, all when that is 0: as many of each capture as of any other, and the first,
// second, … pair of a capture about equally often, because a set has the same angles in the same places.
std::vector<PairTask> spread_out(const std::vector<PairTask>& tasks, int wanted);

// The results of `works`, in their order; the same work is done once. `progress` counts what is not in the
// cache. Throws InputError, OutputError.
std::vector<WorkResult> run_works(const std::vector<Work>& works, const RunnerOptions& options,
                                  const ShowProgress& progress);

}  // namespace traygauge::tables
