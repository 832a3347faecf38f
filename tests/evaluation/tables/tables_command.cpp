#include "tests/evaluation/tables/tables_command.hpp"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <opencv2/core/utility.hpp>
#include <set>

#include "firmware/base/exit_status.hpp"
#include "firmware/evaluate/progress.hpp"
#include "simulator/capture/input_error.hpp"
#include "tests/evaluation/tables/row_figures.hpp"
#include "tests/evaluation/tables/set_folders.hpp"
#include "tests/evaluation/tables/table_runner.hpp"

namespace traygauge::tables {
namespace {

constexpr int kMaxRuns = 1000;
constexpr int kMaxJobs = 64;
constexpr int kMaxPairs = 1'000'000;

struct Options {
  SetOptions sets;
  RunnerOptions runner;
  std::string cache = "paper-tables-cache";
};

int report_error(std::ostream& error, const std::string& text) {
  error << "traygauge-paper-tables: " << printable(text) << "\n";
  return kExitWrongUse;
}

void add_options(CLI::App& app, Options& options) {
  app.add_option("--sets", options.sets.sets,
                 "Folder with the sets meals-45, angles-13, plates-18, meals-14");
  app.add_option("--meals", options.sets.meals, "Folder of captures in the place of Meals-45");
  app.add_option("--angles", options.sets.angles, "… of Angles-13");
  app.add_option("--plates", options.sets.plates, "… of Plates-18");
  app.add_option("--meals14", options.sets.meals14, "… of Meals-14");
  app.add_option("--cache", options.cache,
                 "Folder where measurements are kept, default ./paper-tables-cache");
  app.add_option("--runs", options.runner.runs, "Seeds a pair, default 8")->check(CLI::Range(1, kMaxRuns));
  app.add_option("--jobs", options.runner.jobs, "Pairs measured at the same time, default 1")
      ->check(CLI::Range(1, kMaxJobs));
  app.add_option("--pairs", options.runner.pairs,
                 "Pairs of a set, evenly spread, for a quick look; default all")
      ->check(CLI::Range(1, kMaxPairs));
  app.add_option("--config", options.runner.config, "Folder with dishes/, for captures that name no dish")
      ->envname("TRAYGAUGE_CONFIG");
}

// Rows of sets that were not given are left out, and said to be.
std::vector<Row> measurable_rows(const Table& table, const std::map<PaperSet, std::filesystem::path>& sets,
                                 std::ostream& error) {
  std::vector<Row> rows;
  std::set<PaperSet> absent;
  for (const Row& row : table.rows) {
    if (sets.count(row.set) > 0) {
      rows.push_back(row);
    } else {
      absent.insert(row.set);
    }
  }
  if (rows.empty()) {
    throw UsageError(table.command + ": needs the set " + name(*absent.begin()) +
                     "; name its folder, or with --sets the folder that holds it");
  }
  for (const PaperSet set : absent)
    error << table.command << ": without " << name(set) << ", which was not named\n";
  return rows;
}

std::vector<MeasuredRow> measure_rows(const std::vector<Row>& rows,
                                      const std::map<PaperSet, std::filesystem::path>& sets,
                                      const RunnerOptions& options, std::ostream& error) {
  std::vector<Work> works;
  for (const Row& row : rows) works.push_back({sets.at(row.set), row.variant});
  Progress progress(error, &error == &std::cerr && isatty(STDERR_FILENO) == 1);
  const std::vector<WorkResult> results =
      run_works(works, options, [&](std::size_t done, std::size_t all) { progress.show(done, all); });
  std::vector<MeasuredRow> measured;
  for (std::size_t i = 0; i < rows.size(); ++i)
    measured.push_back({rows[i], figures_of(rows[i], works[i].set, results[i].runs)});
  return measured;
}

int run_command(const CLI::App& app, Options& options, std::ostream& out, std::ostream& error) {
  // As the paper measured time: without parallelism.
  cv::setNumThreads(1);
  options.runner.cache = options.cache;
  const auto sets = find_sets(options.sets);
  const Table table = find_table(app.get_subcommands().front()->get_name()).value();
  const std::vector<Row> rows = measurable_rows(table, sets, error);
  out << compose_text(table, measure_rows(rows, sets, options.runner, error));
  return kExitMeasured;
}

}  // namespace

int run_tables_command(int argument_count, const char* const* arguments, std::ostream& out,
                       std::ostream& error) {
  CLI::App app("Runs the comparisons of the paper again, its figures beside ours.", "traygauge-paper-tables");
  app.require_subcommand(1);
  app.fallthrough();
  Options options;
  add_options(app, options);
  for (const Table& table : paper_tables()) app.add_subcommand(table.command, table.title);
  try {
    app.parse(argument_count, arguments);
    const int status = run_command(app, options, out, error);
    out.flush();
    return out ? status : report_error(error, "the result could not be written to standard output");
  } catch (const CLI::ParseError& problem) {
    if (problem.get_exit_code() == 0) return app.exit(problem, out, error);
    return report_error(error, std::string(problem.what()) + "; see traygauge-paper-tables --help");
  } catch (const std::exception& problem) {  // UsageError, InputError, OutputError
    return report_error(error, problem.what());
  }
}

}  // namespace traygauge::tables
