#include "firmware/evaluate/evaluate_command.hpp"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <ostream>

#include "firmware/base/exit_status.hpp"
#include "firmware/command/program.hpp"
#include "firmware/config/parameters.hpp"
#include "firmware/config/profile.hpp"
#include "firmware/evaluate/evaluation.hpp"
#include "firmware/evaluate/evaluation_plots.hpp"
#include "firmware/evaluate/progress.hpp"
#include "firmware/evaluate/stage_analysis.hpp"
#include "firmware/measure/measure_choices.hpp"
#include "simulator/capture/png_writer.hpp"

namespace traygauge {
namespace {

constexpr int kMaxRuns = 1000;
constexpr int kMaxJobs = 64;

void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  if (!stream.flush()) throw OutputError(file, "it could not be written");
}

bool is_on_terminal(const std::ostream& stream) {
  return &stream == &std::cerr && isatty(STDERR_FILENO) == 1;
}

bool is_any_measured(const Evaluation& evaluation) {
  return std::any_of(evaluation.items.begin(), evaluation.items.end(),
                     [](const ItemEvaluation& item) { return item.figures.estimates > 0; });
}

// Whether results can be stored is known before the work is done.
void create_folder(const std::filesystem::path& folder) {
  std::error_code problem;
  std::filesystem::create_directories(folder, problem);
  if (!std::filesystem::is_directory(folder)) throw OutputError(folder, "it is no folder");
}

void write_files(const std::filesystem::path& folder, const Evaluation& evaluation,
                 const std::vector<PairRuns>& runs) {
  write_text(folder / "estimates.csv", compose_estimates_csv(runs));
  write_text(folder / "runs.csv", compose_runs_csv(runs));
  write_text(folder / "items.csv", compose_items_csv(evaluation));
  write_text(folder / "captures.csv", compose_captures_csv(evaluation));
  write_text(folder / "summary.json", compose_summary_json(evaluation));
  if (!evaluation.outlines.empty()) write_text(folder / "outlines.csv", compose_outlines_csv(runs));
  write_text(folder / "signed_errors.svg", plot_signed_errors(evaluation));
  write_text(folder / "variation.svg", plot_variation(evaluation));
  write_text(folder / "error_by_angle.svg", plot_error_by_angle(evaluation));
  write_text(folder / "volumes.svg", plot_volumes(evaluation));
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
    write_text(folder / "stages.csv", compose_stages_csv(runs));
    write_text(folder / "heights.csv", compose_heights_csv(analysis));
  }
  return compose_stage_tables(analysis);
}

}  // namespace

void add_evaluate_command(Program& program, EvaluateOptions& options) {
  Command command = program.add_command("evaluate", "Measure a set of captures and compare with their truth");
  command.add_option("set", options.set, "A capture with truth.json, or a folder of such");
  command.add_option("--runs", options.runs, "Seeds a pair, default 8").range(1, kMaxRuns);
  command.add_option("--jobs", options.jobs, "Pairs measured at the same time, default 1").range(1, kMaxJobs);
  command.add_option("--profile", options.profile, "best (default) or paper");
  command.add_option("--labels", options.labels,
                     "given (default), or auto: found in the pictures, and compared with the given ones");
  command.add_option("--out", options.out, "Folder for CSV files, plots (SVG) and summary.json");
  command.add_flag("--json", options.json, "Print summary.json instead of tables");
  command.add_flag("--stages", options.stages,
                   "Compare every stage with the truth, and measure with the truth in its place");
  command.add_option("--config", options.config, "Folder with dishes/, for captures that name no dish")
      .environment("TRAYGAUGE_CONFIG");
  command.add_option("--set", options.settings, "Try another value: NAME=VALUE, several times").several();
  command.add_flag("--parameters", options.list_parameters, "List the names for --set with their values");
}

int run_evaluate(const EvaluateOptions& options, std::ostream& out, std::ostream& error) {
  check_label_source(options.labels);
  ProtocolOptions protocol;
  protocol.runs = options.runs;
  protocol.jobs = options.jobs;
  protocol.parameters.profile = choose_profile(options.profile);
  protocol.profile = abilities_of(protocol.parameters.profile);
  for (const std::string& setting : options.settings) set_parameter(protocol.parameters, setting);
  if (options.list_parameters) {
    for (const std::string& line : list_parameters(protocol.parameters)) out << line << "\n";
    return kExitMeasured;
  }
  if (options.stages && protocol.parameters.profile != Profile::best)
    throw UsageError("evaluate: --stages looks into profile best; leave --profile paper out");
  if (options.stages && options.json)
    throw UsageError(
        "evaluate: --stages prints tables; for scripts name a folder with --out instead of --json");
  if (options.set.empty()) throw UsageError("evaluate: name a capture or a folder of captures");
  protocol.config = options.config;
  if (options.labels == "auto") protocol.labels = LabelSource::automatic;
  if (options.stages && protocol.labels == LabelSource::automatic)
    throw UsageError("evaluate: --stages follows given labels; leave --labels auto out");
  if (!options.out.empty()) create_folder(options.out);
  std::vector<std::string> skipped;
  const std::vector<PairRuns> runs = run_with_progress(error, [&](const ShowProgress& progress) {
    return run_protocol(options.set, protocol, skipped, progress);
  });
  const Evaluation evaluation = evaluate_runs(options.set, protocol, runs, skipped);
  if (!options.out.empty()) write_files(options.out, evaluation, runs);
  if (options.stages) out << report_stages(options, protocol, error);
  out << (options.json ? compose_summary_json(evaluation) : compose_tables(evaluation));
  return is_any_measured(evaluation) ? kExitMeasured : kExitNotMeasurable;
}

}  // namespace traygauge
