#include "tests/evaluation/tables/table_measurement.hpp"

#include <unistd.h>

#include <iostream>
#include <map>
#include <set>
#include <string>

#include "firmware/evaluate/progress.hpp"

namespace traygauge::tables {

std::vector<Table> measurable_tables(const std::vector<Table>& tables, const SetFolders& sets,
                                     std::ostream& error) {
  std::vector<Table> measurable;
  std::set<PaperSet> absent;
  for (const Table& table : tables) {
    Table own = table;
    own.rows.clear();
    for (const Row& row : table.rows) {
      if (sets.count(row.set) > 0) {
        own.rows.push_back(row);
      } else {
        absent.insert(row.set);
      }
    }
    if (!own.rows.empty()) measurable.push_back(std::move(own));
  }
  for (const PaperSet set : absent)
    error << "Left out, because the set was not named: rows of " << name(set) << "\n";
  return measurable;
}

std::vector<WorkResult> run_with_progress(const std::vector<Work>& works, const RunnerOptions& options,
                                          std::ostream& error, std::set<std::string>& skipped) {
  std::vector<WorkResult> results;
  {
    Progress progress(error, &error == &std::cerr && isatty(STDERR_FILENO) == 1);
    results = run_works(works, options, [&](std::size_t done, std::size_t all) { progress.show(done, all); });
  }
  std::set<std::string> reasons;
  for (const WorkResult& result : results) reasons.insert(result.skipped.begin(), result.skipped.end());
  for (const std::string& reason : reasons) error << "Left out: " << reason << "\n";
  skipped.merge(reasons);
  return results;
}

std::vector<MeasuredTable> measure_tables(const std::vector<Table>& tables, const SetFolders& sets,
                                          const RunnerOptions& options, std::ostream& error,
                                          std::set<std::string>& skipped) {
  std::vector<Work> works;
  for (const Table& table : tables) {
    for (const Row& row : table.rows) works.push_back({sets.at(row.set), row.variant});
  }
  const std::vector<WorkResult> results = run_with_progress(works, options, error, skipped);
  std::vector<MeasuredTable> measured;
  std::size_t next = 0;
  for (const Table& table : tables) {
    std::map<std::string, std::vector<PairRuns>> runs;  // by the row's title
    for (const Row& row : table.rows) {
      runs[row.title] = runs_of(row, works[next].set, results[next].runs);
      ++next;
    }
    MeasuredTable own{table, {}};
    for (const Row& row : table.rows) {
      const auto reference = runs.find(row.reference);
      const bool is_compared = reference != runs.end() && row.reference != row.title;
      own.rows.push_back({row, figures_of(row, runs.at(row.title),
                                          is_compared ? reference->second : std::vector<PairRuns>())});
    }
    measured.push_back(std::move(own));
  }
  return measured;
}

}  // namespace traygauge::tables
