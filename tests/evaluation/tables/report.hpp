// All tables, and the paper's Fig. 8, as one document in Markdown with plots.
#pragma once

#include <filesystem>
#include <iosfwd>

#include "tests/evaluation/tables/table_measurement.hpp"

namespace traygauge::tables {

// Writes report.md into `folder`, the tables' rows as CSV, both profiles' evaluations into folders of their
// names, and the plots of all that, where gnuplot is installed. Throws InputError, OutputError, PlotError.
void write_report(const std::filesystem::path& folder, const SetFolders& sets, const RunnerOptions& options,
                  std::ostream& error);

}  // namespace traygauge::tables
