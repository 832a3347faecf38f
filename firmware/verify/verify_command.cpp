#include "firmware/verify/verify_command.hpp"

#include <ostream>
#include <system_error>

#include "firmware/base/exit_status.hpp"
#include "firmware/command/program.hpp"
#include "firmware/evaluate/evaluation_files.hpp"
#include "firmware/measure/measure_choices.hpp"
#include "firmware/verify/certificate.hpp"
#include "firmware/verify/verify_captures.hpp"
#include "firmware/verify/verify_classes.hpp"
#include "firmware/verify/verify_guide.hpp"
#include "firmware/verify/verify_station.hpp"
#include "simulator/capture/input_error.hpp"

namespace traygauge {
namespace {

void add_plan_command(Command& verify, VerifyPlanOptions& options) {
  Command command = verify.add_command("plan", "Write a plan to edit: which bodies, where, how often");
  command.add_option("-o,--out", options.out, "The plan, TOML").show_default();
  command.add_option("--dish", options.dish, "The style of the dish that the bodies stand on").show_default();
  command
      .add_option("--length-sigma", options.length_sigma_mm,
                  "How well folded bodies have the drawn lengths, mm; 0 for rendered ones")
      .range(0.0, 5.0)
      .show_default();
}

void add_run_command(Command& verify, VerifyRunOptions& options) {
  Command command = verify.add_command(
      "run", "Scan what the plan says, on a station or on captures; goes on where it ended");
  command.add_option("PLAN", options.plan, "The plan; see traygauge verify plan").required();
  command.add_option("-o,--out", options.out, "The results, one JSON line a scan").required();
  const CommandOption station = command.add_option("--station", options.station, "The station file");
  command.add_option("--captures", options.captures, "Instead of devices: a folder with a capture a step")
      .excludes(station);
  command
      .add_option(
          "--labels", options.labels,
          "Of captures: given (label pictures) or auto (found in the pictures); default: given where a "
          "capture has label pictures")
      .excludes(station);
  command.add_option("--temperature", options.temperature, "For the certificate, such as \"21 °C\"");
  command.add_option("--tester", options.tester, "For the certificate: who tests");
  command.add_option("--config", options.config, "Folder with dishes/, for captures that name no dish")
      .environment("TRAYGAUGE_CONFIG");
}

void add_report_command(Command& verify, VerifyReportOptions& options) {
  Command command =
      verify.add_command("report", "The certificate: figures with intervals, plots, and the class");
  command.add_option("RESULTS", options.record, "What traygauge verify run wrote").required();
  command.add_option("-o,--out", options.out, "Folder for certificate.md, scans.csv and the plots")
      .show_default();
  command.add_option("--class", options.wanted, "The class that decides the exit status: A, B or C")
      .show_default();
  command.add_option("--config", options.config, "Folder with plots/").environment("TRAYGAUGE_CONFIG");
}

}  // namespace

void add_verify_command(Program& program, VerifyOptions& options) {
  Command verify = program.add_command("verify", "Test a station with bodies of known volume");
  // What follows belongs to a program of its own.
  verify.add_command("bodies", "The proof bodies as a PDF to print, cut, fold and glue").take_nothing();
  add_plan_command(verify, options.plan);
  add_run_command(verify, options.run);
  add_report_command(verify, options.report);
}

int run_verify_plan(const VerifyPlanOptions& options, std::ostream& out) {
  std::error_code ignored;
  if (std::filesystem::exists(options.out, ignored))
    throw UsageError(printable(options.out.string()) +
                     " is there already; name another file with --out, or remove it");
  write_text_file(options.out, compose_default_plan(options.dish, options.length_sigma_mm));
  const VerifyPlan plan = read_verify_plan(options.out);
  out << printable(options.out.string()) << ": " << plan.steps.size() << " scans of " << plan.bodies.size()
      << " bodies. Edit it, then traygauge verify run.\n";
  return kExitMeasured;
}

int run_verify(const VerifyRunOptions& options, const std::atomic<bool>& stop, std::ostream& out,
               std::ostream& log) {
  if (options.station.empty() == options.captures.empty())
    throw UsageError("verify run: expected --station FILE, or --captures FOLDER");
  check_label_source(options.labels);
  const VerifyPlan plan = read_verify_plan(options.plan);
  const VerifyRecord record = options.captures.empty() ? run_verify_station(options, plan, stop, out, log)
                                                       : run_verify_captures(options, plan, stop, out);
  out << describe_progress(record) << std::endl;
  return verify_figures(record).is_complete() ? kExitMeasured : kExitNotMeasurable;
}

int run_verify_report(const VerifyReportOptions& options, std::ostream& out, std::ostream& log) {
  const VerifyClass* const wanted = find_verify_class(options.wanted);
  if (wanted == nullptr) throw UsageError("--class: expected A, B or C, found " + printable(options.wanted));
  const VerifyRecord record = read_verify_record(options.record);
  if (record.was_torn)
    log << printable(options.record.string()) << ": the last line is not whole and does not count"
        << std::endl;
  const VerifyFigures figures = verify_figures(record);
  write_certificate(options.out, record, figures, *wanted, options.config, log);
  out << compose_summary(figures, *wanted) << printable((options.out / "certificate.md").string())
      << " says more.\n";
  return find_shortcomings(figures, *wanted).empty() ? kExitMeasured : kExitNotMeasurable;
}

}  // namespace traygauge
