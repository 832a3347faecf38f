#include "firmware/command/command_line.hpp"

#include <CLI/CLI.hpp>
#include <exception>
#include <new>
#include <ostream>
#include <string>

#include "firmware/base/exit_status.hpp"
#include "firmware/measure/measure_command.hpp"
#include "firmware/memory/memory_command.hpp"
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

int run_command(const CLI::App& app, const MeasureOptions& measure, const MemoryOptions& memory,
                std::ostream& out, std::ostream& error) {
  if (app.got_subcommand("measure")) return run_measure(measure, out, error);
  return run_memory(memory, out);
}

}  // namespace

int run_command_line(int argument_count, const char* const* arguments, std::ostream& out,
                     std::ostream& error) {
  CLI::App app("Traygauge measures the volume of the food on a tray from two pictures.", "traygauge");
  app.set_version_flag("--version", TRAYGAUGE_VERSION);
  app.require_subcommand(1);
  MeasureOptions measure;
  MemoryOptions memory;
  add_measure_command(app, measure);
  add_memory_command(app, memory);
  try {
    app.parse(argument_count, arguments);
    const int status = run_command(app, measure, memory, out, error);
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
