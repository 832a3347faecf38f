// Our figures beside the paper's, for one row of a table.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "firmware/evaluate/accuracy.hpp"
#include "firmware/evaluate/protocol.hpp"
#include "tests/evaluation/tables/paper_tables.hpp"

namespace traygauge::tables {

struct RowFigures {
  SetFigures foods;            // of height-field foods
  double time_s = kUndefined;  // mean over the measurements that gave volumes
  int pairs = 0;
};

// `runs`: those of the row's set and variant; `set`: its folder, for what captures say of their dishes.
// Methods that take a dish for flat are compared with the volume above the plane of its bottom, as the
// paper's truth is formed (IV-A), others with that above the dish's inner surface.
RowFigures figures_of(const Row& row, const std::filesystem::path& set, const std::vector<PairRuns>& runs);

struct MeasuredRow {
  Row row;
  RowFigures figures;
};

// For a terminal, at most 110 columns, and as a table in Markdown.
std::string compose_text(const Table& table, const std::vector<MeasuredRow>& rows);
std::string compose_markdown(const Table& table, const std::vector<MeasuredRow>& rows);

}  // namespace traygauge::tables
