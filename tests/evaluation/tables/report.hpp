// All tables, and the paper's Fig. 8, as one document in Markdown with plots.
#pragma once

#include <filesystem>
#include <iosfwd>

#include "tests/evaluation/tables/table_measurement.hpp"

namespace traygauge::tables {

// MAPE by row, the paper's beside ours; SVG.
std::string plot_table(const MeasuredTable& table);

// Writes report.md and its plots into `folder`. Throws InputError, OutputError.
void write_report(const std::filesystem::path& folder, const SetFolders& sets, const RunnerOptions& options,
                  std::ostream& error);

}  // namespace traygauge::tables
