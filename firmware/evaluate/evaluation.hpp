// The protocol's runs, summed up once for the terminal, for scripts and for plots.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "firmware/evaluate/accuracy.hpp"
#include "firmware/evaluate/bootstrap.hpp"
#include "firmware/evaluate/item_series.hpp"
#include "firmware/evaluate/protocol.hpp"
#include "firmware/evaluate/uncertainty.hpp"

namespace traygauge {

// Items compared with one kind of truth.
struct GroupEvaluation {
  std::string key;    // in the JSON
  std::string title;  // for people
  std::vector<ItemSeries> items;
  SetFigures figures;
  SigmaFigures sigma;
  std::optional<ConfidenceInterval> mape_interval;  // 95 %, over captures
  std::optional<ConfidenceInterval> bias_interval;
  std::optional<ConfidenceInterval> coverage_interval;
};

// Median absolute errors of the stages, and the median time; NaN where no run came that far.
struct StageFigures {
  double rotation_deg = kUndefined;
  double direction_deg = kUndefined;
  double scale_percent = kUndefined;
  double bottom_tilt_deg = kUndefined;
  double bottom_offset_mm = kUndefined;  // signed
  double table_tilt_deg = kUndefined;
  double table_offset_mm = kUndefined;  // signed
  double time_ms = kUndefined;
};

struct CaptureEvaluation {
  std::string capture;
  SetFigures foods;              // height-field foods
  SetFigures foods_above_plane;  // above the plane of the dish's bottom, where the group exists
  StageFigures stages;
};

struct AngleEvaluation {
  std::string title;
  double low_deg = 0.0;
  double high_deg = 0.0;  // not included
  int pairs = 0;
  SetFigures foods;
};

struct ItemEvaluation {
  ItemSeries series;  // against volume_ml
  ItemFigures figures;
  SigmaFigures sigma;
};

struct Evaluation {
  std::string set;
  std::string profile;
  int seeds = 0;
  int pairs = 0;
  int measurements = 0;
  // Height-field foods against volume_ml first, always there. Then, where they have items: the same above the
  // plane of the dish's bottom (profiles that take a dish for flat), and scanned fruit against closed and
  // column volume.
  std::vector<GroupEvaluation> groups;
  std::vector<CaptureEvaluation> captures;
  CaptureEvaluation all;
  std::vector<ItemEvaluation> items;              // by capture and label, scanned fruit included
  std::vector<AngleEvaluation> angles;            // bins of 5 degrees that have pairs
  std::optional<AngleEvaluation> optimal_angles;  // 15 to 20 degrees, where a station's arm works
  std::map<std::string, int> refusals;            // cause, measurements
  int items_without_volume = 0;                   // true volume 0: no percentage error
  std::vector<std::string> skipped;               // captures, with the reason
  std::vector<OutlineFigures> outlines;           // by capture, then all; where the segmentation drew them
};

// `runs` as run_protocol() gives them.
Evaluation evaluate_runs(const std::string& set, const ProtocolOptions& options,
                         const std::vector<PairRuns>& runs, const std::vector<std::string>& skipped);

// Why a run has no volume for `label`: the item's status, else the run's.
std::string name_of_refusal(const Run& run, int label);

// Terminal report, at most 100 columns.
std::string compose_tables(const Evaluation& evaluation);

// For scripts: one JSON document.
std::string compose_summary_json(const Evaluation& evaluation);

// For a spreadsheet. A row an item of each run:
std::string compose_estimates_csv(const std::vector<PairRuns>& runs);
// A row an item of each pair, with means over its seeds:
std::string compose_pairs_csv(const std::vector<PairRuns>& runs);
// A row a run: how far each stage came, and how far from the truth it lies.
std::string compose_runs_csv(const std::vector<PairRuns>& runs);
// A row an item, over its pairs and seeds:
std::string compose_items_csv(const Evaluation& evaluation);
// A row a capture, and last one for all:
std::string compose_captures_csv(const Evaluation& evaluation);

}  // namespace traygauge
