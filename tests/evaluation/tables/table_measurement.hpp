// Tables with our figures filled in.
#pragma once

#include <iosfwd>
#include <set>
#include <string>
#include <vector>

#include "tests/evaluation/tables/row_figures.hpp"
#include "tests/evaluation/tables/set_folders.hpp"
#include "tests/evaluation/tables/table_runner.hpp"

namespace traygauge::tables {

struct MeasuredTable {
  Table table;
  std::vector<MeasuredRow> rows;
};

// Without the rows whose set is not at hand; `error` is told which sets those are.
std::vector<Table> measurable_tables(const std::vector<Table>& tables, const SetFolders& sets,
                                     std::ostream& error);

// Measures what is not in the cache, and tells `error` of the progress and of captures left out, which it
// adds to `skipped` with the reasons. Throws InputError, OutputError.
std::vector<WorkResult> run_with_progress(const std::vector<Work>& works, const RunnerOptions& options,
                                          std::ostream& error, std::set<std::string>& skipped);
std::vector<MeasuredTable> measure_tables(const std::vector<Table>& tables, const SetFolders& sets,
                                          const RunnerOptions& options, std::ostream& error,
                                          std::set<std::string>& skipped);

}  // namespace traygauge::tables
