#include "firmware/evaluate/evaluate_command.hpp"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <ostream>

#include "firmware/base/exit_status.hpp"
#include "firmware/command/program.hpp"
#include "firmware/config/config_folder.hpp"
#include "firmware/config/parameters.hpp"
#include "firmware/config/profile.hpp"
#include "firmware/evaluate/evaluation.hpp"
#include "firmware/evaluate/evaluation_files.hpp"
#include "firmware/evaluate/progress.hpp"
#include "firmware/evaluate/stage_analysis.hpp"
#include "firmware/measure/measure_choices.hpp"

namespace traygauge {
namespace {

constexpr int kMaxRuns = 1000;
constexpr int kMaxJobs = 64;

bool is_on_terminal(const std::ostream& stream) {
  return &stream == &std::cerr && isatty(STDERR_FILENO) == 1;
}

bool is_any_measured(const Evaluation& evaluation) {
  return std::any_of(evaluation.items.begin(), evaluation.items.end(),
                     [](const ItemEvaluation& item) { return item.figures.estimates > 0; });
}

// `run` takes a ShowProgress.
template <class Run>
auto run_with_progress(std::ostream& error, Run run) {
  Progress progress(error, is_on_terminal(error));
  return run([&](std::size_t done, std::size_t all) { progress.show(done, all); });
}

// Compares the stages with the truth, and returns the tables for the terminal.
std::string report_stages(const EvaluateOptions& options, const ProtocolOptions& protocol,
                          std::ostream& error) {
  std::vector<std::string> skipped;  // the protocol has named them
  const StageRuns runs = run_with_progress(error, [&](const ShowProgress& progress) {
    return run_stages(options.set, protocol, skipped, progress);
  });
  const StageAnalysis analysis = analyse_stages(runs);
  if (!options.out.empty()) {
    const std::filesystem::path folder = options.out;
    write_text_file(folder / "stages.csv", compose_stages_csv(runs));
    write_text_file(folder / "heights.csv", compose_heights_csv(analysis));
  }
  return compose_stage_tables(analysis);
}

// Throws UsageError for what cannot be combined.
void check_options(const EvaluateOptions& options, Profile profile) {
  if (options.set.empty()) throw UsageError("evaluate: name a capture or a folder of captures");
  if (!options.stages) return;
  if (profile != Profile::best)
    throw UsageError("evaluate: --stages looks into profile best; leave --profile paper out");
  if (options.json)
    throw UsageError(
        "evaluate: --stages prints tables; for scripts name a folder with --out instead of --json");
  if (options.labels == "auto")
    throw UsageError("evaluate: --stages follows given labels; leave --labels auto out");
}

ProtocolOptions choose_protocol(const EvaluateOptions& options) {
  check_label_source(options.labels);
  ProtocolOptions protocol;
  protocol.runs = options.runs;
  protocol.jobs = options.jobs;
  protocol.parameters.profile = choose_profile(options.profile);
  protocol.profile = abilities_of(protocol.parameters.profile);
  protocol.config = options.config;
  if (options.labels == "auto") protocol.labels = LabelSource::automatic;
  for (const std::string& setting : options.settings) set_parameter(protocol.parameters, setting);
  return protocol;
}

// Whether results can be stored and drawn is known before the work is done.
std::vector<Plot> prepare_plots(const EvaluateOptions& options) {
  if (options.out.empty()) return {};
  create_folder(options.out);
  return plots_of_evaluation(find_plots_folder(options.config), options.out);
}

}  // namespace

void add_evaluate_command(Program& program, EvaluateOptions& options) {
  Command command = program.add_command("evaluate", "Measure a set of captures and compare with their truth");
  command.add_option("SET", options.set, "A capture with truth.json, or a folder of such");
  command.add_option("--runs", options.runs, "Seeds a pair, default 8").range(1, kMaxRuns);
  command.add_option("--jobs", options.jobs, "Pairs measured at the same time, default 1").range(1, kMaxJobs);
  command.add_option("--profile", options.profile, "best (default) or paper");
  command.add_option("--labels", options.labels,
                     "given (default), or auto: found in the pictures, and compared with the given ones");
  command.add_option("--out", options.out,
                     "Folder for CSV files, summary.json and, where gnuplot is installed, plots (SVG)");
  command.add_flag("--json", options.json, "Print summary.json instead of tables");
  command.add_flag("--stages", options.stages,
                   "Compare every stage with the truth, and measure with the truth in its place");
  command
      .add_option("--config", options.config,
                  "Folder with dishes/, for captures that name no dish, and plots/")
      .environment("TRAYGAUGE_CONFIG");
  command.add_option("--set", options.settings, "Try another value: NAME=VALUE, several times").several();
  command.add_flag("--parameters", options.list_parameters, "List the names for --set with their values");
}

int run_evaluate(const EvaluateOptions& options, std::ostream& out, std::ostream& error) {
  const ProtocolOptions protocol = choose_protocol(options);
  if (options.list_parameters) {
    for (const std::string& line : list_parameters(protocol.parameters)) out << line << "\n";
    return kExitMeasured;
  }
  check_options(options, protocol.parameters.profile);
  const std::vector<Plot> plots = prepare_plots(options);
  std::vector<std::string> skipped;
  const std::vector<PairRuns> runs = run_with_progress(error, [&](const ShowProgress& progress) {
    return run_protocol(options.set, protocol, skipped, progress);
  });
  const Evaluation evaluation = evaluate_runs(options.set, protocol, runs, skipped);
  if (!options.out.empty()) write_evaluation_files(options.out, evaluation, runs);
  if (options.stages) out << report_stages(options, protocol, error);
  out << (options.json ? compose_summary_json(evaluation) : compose_tables(evaluation));
  draw_plots(plots, error);  // last: where it fails, all else is there
  return is_any_measured(evaluation) ? kExitMeasured : kExitNotMeasurable;
}

}  // namespace traygauge
