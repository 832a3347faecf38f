// Our figures beside the paper's, for one row of a table.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "firmware/evaluate/accuracy.hpp"
#include "firmware/evaluate/bootstrap.hpp"
#include "firmware/evaluate/protocol.hpp"
#include "tests/evaluation/tables/paired_difference.hpp"
#include "tests/evaluation/tables/paper_tables.hpp"

namespace traygauge::tables {

// Of height-field foods, against one kind of truth.
struct TruthFigures {
  double mape = kUndefined;
  std::optional<ConfidenceInterval> interval;  // 95 %, by bootstrap over captures
  PairedDifference difference;                 // to the row's reference
};

// What volumes are compared with: what a flat dish would hold, and what stands on the dish as it is.
inline constexpr std::array<TruthVolume, 2> kRowTruths = {TruthVolume::above_bottom_plane,
                                                          TruthVolume::above_dish};

struct RowFigures {
  SetFigures foods;            // of height-field foods
  double time_s = kUndefined;  // mean over the measurements that gave volumes
  int pairs = 0;
  std::array<TruthFigures, kRowTruths.size()> by_truth;  // in the order of kRowTruths
};

// Of the runs of a row's set and variant those that the row speaks of. `set`: the set's folder, for what
// captures say of their dishes.
std::vector<PairRuns> runs_of(const Row& row, const std::filesystem::path& set,
                              const std::vector<PairRuns>& runs);

// Of what runs_of() gives; `reference`: that of the row's reference, empty where it has none. `foods` of
// methods that take a dish for flat are compared with the volume above the plane of its bottom, as the
// paper's truth is formed (IV-A), others with that above the dish's inner surface.
RowFigures figures_of(const Row& row, const std::vector<PairRuns>& runs,
                      const std::vector<PairRuns>& reference);

struct MeasuredRow {
  Row row;
  RowFigures figures;
};

// For a terminal, at most 110 columns, and as tables in Markdown.
std::string compose_text(const Table& table, const std::vector<MeasuredRow>& rows);
std::string compose_markdown(const Table& table, const std::vector<MeasuredRow>& rows);

}  // namespace traygauge::tables
