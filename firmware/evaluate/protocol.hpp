// The paper's protocol (IV-B): every pair of every capture, several seeds.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/pipeline/measurement.hpp"
#include "firmware/config/profile.hpp"
#include "firmware/evaluate/outline_figures.hpp"
#include "firmware/evaluate/pair_tasks.hpp"
#include "firmware/evaluate/profile_abilities.hpp"
#include "firmware/evaluate/stage_errors.hpp"
#include "firmware/measure/capture_session.hpp"
#include "simulator/capture/capture.hpp"
#include "simulator/capture/truth.hpp"

namespace traygauge {

struct ProtocolOptions {
  int runs = 8;                  // seeds 1 … runs (paper: 8)
  int jobs = 1;                  // captures' pairs measured at the same time
  ProfileParameters parameters;  // camera, card and dish come from the captures
  ProfileAbilities profile = abilities_of(Profile::best);
  std::string config;  // folder with dishes/, for captures that name no dish; empty: the usual one
  LabelSource labels = LabelSource::given;  // automatic: compared with those given
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
  double all_food_ml = 0.0;  // of what was measured, whatever it was taken for
  WarningSet warnings;
  MeasurementReport report;
  std::optional<StageErrors> errors;  // where it came as far as volumes
};

// What a run says about `label`; nothing when it was refused. Points into `run`.
const ItemEstimate* estimate_of(const Run& run, int label);

bool is_warned(const Run& run);

// A measurement as a run, without errors of its stages.
Run record_run(const Measurement& measurement, std::uint64_t seed);

struct PairRuns {
  std::string capture;  // path below the set
  std::array<int, 2> pair{};
  std::optional<double> true_angle_deg;  // by the poses of truth.json, where it has them
  Truth truth;
  std::optional<PairOutlines> outlines;  // where the segmentation drew them
  std::vector<Run> runs;
};

// A pair with its truth, and without runs. Throws InputError.
PairRuns describe_pair(const PairTask& task, const Truth& truth);

// One pair of a capture with its truth.
class PairRunner {
 public:
  // Throws InputError.
  PairRunner(const PairTask& task, const ProtocolOptions& options);

  PairRuns start() const;
  Run measure(std::uint64_t seed, StageObserver* observer = nullptr);

  const Capture& capture() const { return capture_; }
  const Truth& truth() const { return truth_; }
  const std::optional<PairTruth>& pair_truth() const { return pair_truth_; }

 private:
  PairTask task_;
  Capture capture_;
  Truth truth_;
  std::optional<PairTruth> pair_truth_;  // where the truth has poses
  std::vector<DishDescription> dishes_;
  CaptureSession session_;
  std::array<std::uint8_t, 256> meaning_{};  // of labels that were drawn: those of the truth
};

// Measures all pairs, ordered by capture. Captures without truth, and those that the profile cannot measure,
// are named in `skipped` with the reason. The results do not depend on `options.jobs`. Throws InputError.
std::vector<PairRuns> run_protocol(const std::filesystem::path& set, const ProtocolOptions& options,
                                   std::vector<std::string>& skipped, const ShowProgress& progress);

}  // namespace traygauge
