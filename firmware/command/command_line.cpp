#include "firmware/command/command_line.hpp"

#include <CLI/CLI.hpp>

#include "firmware/check/check_command.hpp"
#include "firmware/command/program.hpp"
#include "firmware/command/sibling_program.hpp"
#include "firmware/enrol/enrol_command.hpp"
#include "firmware/evaluate/evaluate_command.hpp"
#include "firmware/measure/measure_command.hpp"
#include "firmware/memory/memory_command.hpp"
#include "firmware/record/record_command.hpp"
#include "firmware/segment/segment_command.hpp"
#include "firmware/station/recorded_captures.hpp"
#include "firmware/station/station_command.hpp"
#include "firmware/station/stop_signal.hpp"

namespace traygauge {
namespace {

struct Options {
  MeasureOptions measure;
  EvaluateOptions evaluate;
  EnrolOptions enrol;
  MemoryOptions memory;
  SegmentOptions segment;
  StationCommand station;
  CheckOptions check;
  RecordOptions record;
};

// What follows belongs to a program of its own.
void add_calibrate_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "calibrate", "The lens from pictures of a chessboard, the arm from captures of the card");
  command->set_help_flag();
  command->prefix_command();
}

int run_command(const CLI::App& app, const Options& options, std::ostream& out, std::ostream& error) {
  if (app.got_subcommand("measure")) return run_measure(options.measure, out, error);
  if (app.got_subcommand("evaluate")) return run_evaluate(options.evaluate, out, error);
  if (app.got_subcommand("enrol-dish")) return run_enrol(options.enrol, out);
  if (app.got_subcommand("segment")) return run_segment(options.segment, out);
  if (app.got_subcommand("station")) {
    return run_station(options.station, open_recorded_captures, stop_on_signals(), out, error);
  }
  if (app.got_subcommand("check")) return run_check(options.check, out);
  if (app.got_subcommand("calibrate")) {
    return run_sibling_program("traygauge-calibrate", app.get_subcommand("calibrate")->remaining());
  }
  if (app.got_subcommand("record")) return run_record(options.record, stop_on_signals(), out, error);
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
  add_segment_command(app, options.segment);
  add_enrol_command(app, options.enrol);
  add_memory_command(app, options.memory);
  add_station_command(app, options.station);
  add_check_command(app, options.check);
  add_record_command(app, options.record);
  add_calibrate_command(app);
  const auto run = [&] { return run_command(app, options, out, error); };
  return run_program(app, argument_count, arguments, run, out, error);
}

}  // namespace traygauge
