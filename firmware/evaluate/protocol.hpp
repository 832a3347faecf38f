// The paper's protocol (IV-B): every pair of every capture, several seeds.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/estimator/configuration.hpp"
#include "core/estimator/measurement.hpp"
#include "firmware/evaluate/profile_abilities.hpp"
#include "firmware/evaluate/stage_errors.hpp"
#include "simulator/capture/truth.hpp"

namespace traygauge {

struct ProtocolOptions {
  int runs = 8;              // seeds 1 … runs (paper: 8)
  int jobs = 1;              // captures' pairs measured at the same time
  Configuration parameters;  // of the stages; camera, card and dish come from the captures
  ProfileAbilities profile = abilities_of(Profile::best);
  std::string config;  // folder with dishes/, for captures that name no dish; empty: the usual one
};

struct ItemEstimate {
  int label = 0;
  StatusCode status = StatusCode::ok;
  double volume_ml = 0.0;
  double column_volume_ml = 0.0;
  double sigma_ml = 0.0;  // 0: not estimated
};

// One measurement.
struct Run {
  std::uint64_t seed = 0;
  StatusCode status = StatusCode::ok;
  std::vector<ItemEstimate> items;
  double relative_angle_deg = 0.0;
  double total_ms = 0.0;
  std::array<bool, kWarningCount> warnings{};
  MeasurementReport report;
  std::optional<StageErrors> errors;  // where it came as far as volumes
};

// What a run says about `label`; nothing when it was refused. Points into `run`.
const ItemEstimate* estimate_of(const Run& run, int label);

bool is_warned(const Run& run);

struct PairRuns {
  std::string capture;  // path below the set
  std::array<int, 2> pair{};
  std::optional<double> true_angle_deg;  // by the poses of truth.json, where it has them
  Truth truth;
  std::vector<Run> runs;
};

// Folders with capture.json at or below `set`, sorted. Throws InputError when there is none.
std::vector<std::filesystem::path> find_captures(const std::filesystem::path& set);

// Measures all pairs, ordered by capture. Captures without truth, and those that the profile cannot measure,
// are named in `skipped` with the reason. `progress` is told how many of how many measurements are done,
// never by two threads at once. The results do not depend on `options.jobs`. Throws InputError.
std::vector<PairRuns> run_protocol(const std::filesystem::path& set, const ProtocolOptions& options,
                                   std::vector<std::string>& skipped,
                                   const std::function<void(std::size_t, std::size_t)>& progress);

}  // namespace traygauge
