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
#include "firmware/evaluate/stage_errors.hpp"
#include "simulator/capture/truth.hpp"

namespace traygauge {

struct ProtocolOptions {
  int runs = 8;              // seeds 1 … runs (paper: 8)
  int jobs = 1;              // captures' pairs measured at the same time
  Configuration parameters;  // of the stages; camera, card and dish come from the captures
  std::string config;        // folder with dishes/, for captures that name none; empty: the usual one
};

struct ItemEstimate {
  int label = 0;
  StatusCode status = StatusCode::ok;
  double volume_ml = 0.0;
};

// One measurement.
struct Run {
  std::uint64_t seed = 0;
  StatusCode status = StatusCode::ok;
  std::vector<ItemEstimate> items;
  double relative_angle_deg = 0.0;
  double total_ms = 0.0;
  MeasurementReport report;
  std::optional<StageErrors> errors;  // where it came as far as volumes
};

// The volume of `label` in a run; nothing when it was refused.
std::optional<double> estimate_of(const Run& run, int label);

struct PairRuns {
  std::string capture;  // path below the set
  std::array<int, 2> pair{};
  Truth truth;
  std::vector<Run> runs;
};

// Folders with capture.json at or below `set`, sorted. Throws InputError when there is none.
std::vector<std::filesystem::path> find_captures(const std::filesystem::path& set);

// Measures all pairs; captures without truth or with several dishes are named in `skipped`. `progress` is
// told how many of how many pairs are done. Throws InputError.
std::vector<PairRuns> run_protocol(const std::filesystem::path& set, const ProtocolOptions& options,
                                   std::vector<std::string>& skipped,
                                   const std::function<void(std::size_t, std::size_t)>& progress);

}  // namespace traygauge
