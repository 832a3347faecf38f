// Which stage of profile `best` loses the most: every pair measured as it is, and with the truth in the place
// of one stage after the other.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "firmware/evaluate/protocol.hpp"
#include "firmware/evaluate/stage_substitution.hpp"

namespace traygauge {

struct StageVariant {
  const char* key = "";    // in CSV
  const char* title = "";  // for people
  TrueStages replaced{};
};

// The first replaces nothing, the last everything.
inline constexpr std::size_t kStageVariants = kTrueStages + 2;
const std::array<StageVariant, kStageVariants>& stage_variants();

struct StageRuns {
  std::array<std::vector<PairRuns>, kStageVariants> variants;  // the same pairs, one run each
  std::vector<HeightErrorsByLabel> heights;                    // of each pair, nothing replaced
};

// Measures all pairs whose truth has poses with seed 1. Skips, reports progress and throws as run_protocol().
StageRuns run_stages(const std::filesystem::path& set, const ProtocolOptions& options,
                     std::vector<std::string>& skipped, const ShowProgress& progress);

// Heights of one label in one capture, over its pairs and both views. NaN where no true height is known.
struct LabelHeights {
  std::string capture;
  int label = 0;
  std::string name;
  double matched_percent = 0.0;
  double median_mm = 0.0;  // of the absolute error
  double p95_mm = 0.0;     // of the absolute error
  double bias_mm = 0.0;    // mean; positive: too high
};

// Height-field foods of one capture, or of all of them.
struct StageLosses {
  std::string capture;
  std::array<double, kStageVariants> mape{};  // per cent
  std::array<double, kStageVariants> bias{};
};

struct StageAnalysis {
  std::vector<LabelHeights> heights;
  std::vector<StageLosses> losses;  // by capture
  StageLosses all;
};

StageAnalysis analyse_stages(const StageRuns& runs);

// Terminal report, at most 100 columns.
std::string compose_stage_tables(const StageAnalysis& analysis);
// A row an item of each pair, a column a variant.
std::string compose_stages_csv(const StageRuns& runs);
// A row a label of each capture.
std::string compose_heights_csv(const StageAnalysis& analysis);

}  // namespace traygauge
