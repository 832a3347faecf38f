#include "firmware/command/command_line.hpp"

#include <CLI/CLI.hpp>
#include <exception>
#include <new>
#include <ostream>
#include <string>

#include "firmware/base/exit_status.hpp"
#include "firmware/enrol/enrol_command.hpp"
#include "firmware/evaluate/evaluate_command.hpp"
#include "firmware/measure/measure_command.hpp"
#include "firmware/memory/memory_command.hpp"
#include "firmware/station/recorded_captures.hpp"
#include "firmware/station/station_command.hpp"
#include "firmware/station/stop_signal.hpp"
#include "simulator/capture/input_error.hpp"

namespace traygauge {
namespace {

int report_error(std::ostream& error, const std::string& text) {
  error << "traygauge: " << printable(text) << "\n";
  return kExitWrongUse;
}

// What was asked for, or what is wrong with it.
int report_parse(const CLI::App& app, const CLI::ParseError& problem, std::ostream& out,
                 std::ostream& error) {
  if (problem.get_exit_code() == 0) return app.exit(problem, out, error);  // --help, --version
  return report_error(error, std::string(problem.what()) + "; see traygauge --help");
}

struct Options {
  MeasureOptions measure;
  EvaluateOptions evaluate;
  EnrolOptions enrol;
  MemoryOptions memory;
  StationCommand station;
};

int run_command(const CLI::App& app, const Options& options, std::ostream& out, std::ostream& error) {
  if (app.got_subcommand("measure")) return run_measure(options.measure, out, error);
  if (app.got_subcommand("evaluate")) return run_evaluate(options.evaluate, out, error);
  if (app.got_subcommand("enrol-dish")) return run_enrol(options.enrol, out);
  if (app.got_subcommand("station")) {
    return run_station(options.station, open_recorded_captures, stop_on_signals(), out, error);
  }
  return run_memory(options.memory, out);
}

}  // namespace

int run_command_line(int argument_count, const char* const* arguments, std::ostream& out,
                     std::ostream& error) {
  CLI::App app("Traygauge measures the volume of the food on a tray from two pictures.", "traygauge");
  app.set_version_flag("--version", TRAYGAUGE_VERSION);
  app.require_subcommand(1);
  Options options;
  add_measure_command(app, options.measure);
  add_evaluate_command(app, options.evaluate);
  add_enrol_command(app, options.enrol);
  add_memory_command(app, options.memory);
  add_station_command(app, options.station);
  try {
    app.parse(argument_count, arguments);
    const int status = run_command(app, options, out, error);
    out.flush();
    return out ? status : report_error(error, "the result could not be written to standard output");
  } catch (const CLI::ParseError& problem) {
    return report_parse(app, problem, out, error);
  } catch (const std::bad_alloc&) {
    return report_error(error, "too little memory for pictures of this size; see traygauge memory");
  } catch (const std::exception& problem) {  // UsageError, InputError, OutputError
    return report_error(error, problem.what());
  }
}

}  // namespace traygauge
