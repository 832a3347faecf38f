#include "tests/evaluation/tables/tables_command.hpp"

#include <algorithm>
#include <opencv2/core/utility.hpp>
#include <ostream>
#include <set>
#include <string>

#include "firmware/base/exit_status.hpp"
#include "firmware/command/program.hpp"
#include "simulator/capture/input_error.hpp"
#include "tests/evaluation/tables/report.hpp"
#include "tests/evaluation/tables/set_folders.hpp"
#include "tests/evaluation/tables/table_measurement.hpp"

namespace traygauge::tables {
namespace {

constexpr int kMaxRuns = 1000;
constexpr int kMaxJobs = 64;
constexpr int kMaxPairs = 1'000'000;
constexpr double kMaxNoiseGrey = 100.0;

struct Options {
  SetOptions sets;
  RunnerOptions runner;
  std::string cache = "paper-tables-cache";
  std::string out;
};

void add_options(Program& program, Options& options) {
  Command all = program.whole();
  all.add_option("--sets", options.sets.sets,
                 "Folder with the sets meals-45, angles-13, plates-18, meals-14");
  all.add_option("--meals", options.sets.meals, "Folder of captures in the place of Meals-45");
  all.add_option("--angles", options.sets.angles, "… of Angles-13");
  all.add_option("--plates", options.sets.plates, "… of Plates-18");
  all.add_option("--meals14", options.sets.meals14, "… of Meals-14");
  all.add_option("--cache", options.cache,
                 "Folder where measurements are kept, default ./paper-tables-cache");
  all.add_option("--runs", options.runner.runs, "Seeds a pair, default 8").range(1, kMaxRuns);
  all.add_option("--jobs", options.runner.jobs, "Pairs measured at the same time, default 1")
      .range(1, kMaxJobs);
  all.add_option("--pairs", options.runner.pairs,
                 "Pairs of a set, spread over captures and angles, for a quick look; default all")
      .range(1, kMaxPairs);
  all.add_option("--noise-grey", options.runner.pictures.noise_grey,
                 "Noise added to the pictures: standard deviation in grey values, default 0")
      .range(0.0, kMaxNoiseGrey);
  all.add_flag("--local-tone", options.runner.pictures.local_tone,
               "Even out the contrast over parts of the pictures, as phones do");
  all.add_option("--config", options.runner.config, "Folder with dishes/, for captures that name no dish")
      .environment("TRAYGAUGE_CONFIG");
}

bool is_any_measured(const MeasuredTable& table) {
  return std::any_of(table.rows.begin(), table.rows.end(),
                     [](const MeasuredRow& row) { return row.figures.foods.estimates > 0; });
}

int print_table(const Table& table, const SetFolders& sets, const RunnerOptions& options, std::ostream& out,
                std::ostream& error) {
  const std::vector<Table> tables = measurable_tables({table}, sets, error);
  if (tables.empty()) {
    throw UsageError(table.command + ": needs the set " + name(table.rows.front().set) +
                     "; name its folder, or with --sets the folder that holds it");
  }
  std::set<std::string> skipped;
  const MeasuredTable measured = measure_tables(tables, sets, options, error, skipped).front();
  out << compose_text(measured.table, measured.rows);
  return is_any_measured(measured) ? kExitMeasured : kExitNotMeasurable;
}

int run_command(const Program& program, Options& options, std::ostream& out, std::ostream& error) {
  // As the paper measured time: without parallelism.
  cv::setNumThreads(1);
  options.runner.cache = options.cache;
  const SetFolders sets = find_sets(options.sets);
  const std::string command = program.chosen();
  if (command != "report") return print_table(find_table(command).value(), sets, options.runner, out, error);
  if (sets.empty()) throw UsageError("report: name the folder that holds the sets with --sets, or each set");
  write_report(options.out, sets, options.runner, error);
  return kExitMeasured;
}

}  // namespace

int run_tables_command(int argument_count, const char* const* arguments, std::ostream& out,
                       std::ostream& error) {
  Program program("Runs the comparisons of the paper again, its figures beside ours.",
                  "traygauge-paper-tables");
  program.take_options_after_commands();
  Options options;
  add_options(program, options);
  for (const Table& table : paper_tables()) program.add_command(table.command, table.title);
  program.add_command("report", "All of it as Markdown with plots, for both profiles")
      .add_option("--out", options.out, "Folder for report.md and its plots")
      .required();
  return program.run(
      argument_count, arguments, [&] { return run_command(program, options, out, error); }, out, error);
}

}  // namespace traygauge::tables
