#include "firmware/evaluate/evaluate_command.hpp"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <ostream>

#include "firmware/base/exit_status.hpp"
#include "firmware/base/text.hpp"
#include "firmware/config/parameters.hpp"
#include "firmware/config/profile.hpp"
#include "firmware/evaluate/evaluation.hpp"
#include "firmware/measure/measure_command.hpp"
#include "simulator/capture/png_writer.hpp"

namespace traygauge {
namespace {

constexpr int kMaxRuns = 1000;
constexpr int kMaxJobs = 64;

// "12 of 36 pairs, 40 s left", over itself.
class ProgressLine {
 public:
  explicit ProgressLine(std::ostream& stream) : stream_(stream) {}

  void show(std::size_t done, std::size_t all) {
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
    const double left_s = elapsed.count() / static_cast<double>(done) * static_cast<double>(all - done);
    stream_ << "\r" << done << " of " << all << " pairs, " << fixed(left_s, 0) << " s left   " << std::flush;
    if (done == all) stream_ << "\r" << std::string(kWidth, ' ') << "\r" << std::flush;
  }

 private:
  static constexpr std::size_t kWidth = 40;
  std::ostream& stream_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  if (!stream.flush()) throw OutputError(file, "it could not be written");
}

bool is_any_measured(const std::vector<PairRuns>& runs) {
  for (const PairRuns& pair : runs) {
    for (const Run& run : pair.runs) {
      if (run.status == StatusCode::ok || run.status == StatusCode::partial) return true;
    }
  }
  return false;
}

}  // namespace

void add_evaluate_command(CLI::App& app, EvaluateOptions& options) {
  CLI::App* command =
      app.add_subcommand("evaluate", "Measure a set of captures and compare with their truth");
  command->add_option("set", options.set, "A capture with truth.json, or a folder of such");
  command->add_option("--runs", options.runs, "Seeds a pair, default 8")->check(CLI::Range(1, kMaxRuns));
  command->add_option("--jobs", options.jobs, "Pairs measured at the same time, default 1")
      ->check(CLI::Range(1, kMaxJobs));
  command->add_option("--profile", options.profile, "paper (default)");
  command->add_option("--labels", options.labels, "given (default)");
  command->add_option("--out", options.out, "Folder for estimates.csv and runs.csv");
  command->add_option("--config", options.config, "Folder with dishes/, for captures that name no dish")
      ->envname("TRAYGAUGE_CONFIG");
  command->add_option("--set", options.settings, "Try another value: NAME=VALUE, several times")->take_all();
  command->add_flag("--parameters", options.list_parameters, "List the names for --set with their values");
}

int run_evaluate(const EvaluateOptions& options, std::ostream& out, std::ostream& error) {
  choose_profile(options.profile);
  check_label_source(options.labels);
  ProtocolOptions protocol;
  protocol.runs = options.runs;
  protocol.jobs = options.jobs;
  for (const std::string& setting : options.settings) set_parameter(protocol.parameters, setting);
  if (options.list_parameters) {
    for (const std::string& line : list_parameters(protocol.parameters)) out << line << "\n";
    return kExitMeasured;
  }
  if (options.set.empty()) throw UsageError("evaluate: name a capture or a folder of captures");
  protocol.config = options.config;
  if (!options.out.empty()) std::filesystem::create_directories(options.out);
  std::vector<std::string> skipped;
  ProgressLine progress(error);
  const std::vector<PairRuns> runs = run_protocol(
      options.set, protocol, skipped, [&](std::size_t done, std::size_t all) { progress.show(done, all); });
  for (const std::string& line : skipped) out << "skipped " << line << "\n";
  out << compose_evaluation(runs);
  if (!options.out.empty()) {
    write_text(std::filesystem::path(options.out) / "estimates.csv", compose_estimates_csv(runs));
    write_text(std::filesystem::path(options.out) / "runs.csv", compose_runs_csv(runs));
  }
  return is_any_measured(runs) ? kExitMeasured : kExitNotMeasurable;
}

}  // namespace traygauge
