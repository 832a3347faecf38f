#include "firmware/command/command_line.hpp"

#include <iostream>
#include <string>
#include <vector>

#include "firmware/base/build_info.hpp"
#include "firmware/check/check_command.hpp"
#include "firmware/check/config_check.hpp"
#include "firmware/check/self_check.hpp"
#include "firmware/command/program.hpp"
#include "firmware/command/sibling_program.hpp"
#include "firmware/command/stop_signal.hpp"
#include "firmware/enrol/enrol_command.hpp"
#include "firmware/evaluate/evaluate_command.hpp"
#include "firmware/measure/measure_command.hpp"
#include "firmware/memory/memory_command.hpp"
#include "firmware/network/network_command.hpp"
#include "firmware/record/record_command.hpp"
#include "firmware/segment/segment_command.hpp"
#include "firmware/setup/setup_command.hpp"
#include "firmware/station/open_captures.hpp"
#include "firmware/station/station_command.hpp"
#include "firmware/support/backup_command.hpp"
#include "firmware/support/restore_command.hpp"
#include "firmware/support/support_command.hpp"
#include "firmware/verify/verify_command.hpp"

namespace traygauge {
namespace {

struct Options {
  MeasureOptions measure;
  EvaluateOptions evaluate;
  EnrolOptions enrol;
  MemoryOptions memory;
  NetworkOptions network;
  SegmentOptions segment;
  StationCommand station;
  CheckOptions check;
  ConfigCheckOptions config_check;
  SelfCheckOptions self_check;
  SetupOptions setup;
  RecordOptions record;
  SupportOptions support;
  BackupOptions backup;
  RestoreOptions restore;
  VerifyOptions verify;
};

// What follows belongs to a program of its own.
void add_calibrate_command(Program& program) {
  Command command = program.add_command(
      "calibrate", "The lens from pictures of a chessboard, the arm from captures of the card");
  command.take_nothing();
}

// The same.
void add_card_command(Program& program) {
  program.add_command("card", "Make the reference card to print, and read what a caliper says of it")
      .take_nothing();
}

// The same: it holds no device, and nothing of the measurement.
void add_hub_command(Program& program) {
  program.add_command("hub", "Store what stations measure").take_nothing();
}

// The same; it may run where no station is.
void add_collect_command(Program& program) {
  program.add_command("collect", "Store what many hubs publish, and give them receipts").take_nothing();
}

int run_command(const Program& program, const Options& options, std::ostream& out, std::ostream& error) {
  const std::string command = program.chosen();
  if (command == "measure") return run_measure(options.measure, out, error);
  if (command == "evaluate") return run_evaluate(options.evaluate, out, error);
  if (command == "enrol-dish") return run_enrol(options.enrol, out);
  if (command == "segment") return run_segment(options.segment, out);
  if (command == "network") return run_network(options.network, out);
  if (command == "station") {
    return run_station(options.station, open_recorded_captures, stop_on_signals(), out, error);
  }
  if (command == "check") return run_check(options.check, out);
  if (command == "setup") return run_setup(options.setup, system_setup_tools(), std::cin, out);
  if (command == "self-check") return run_self_check(options.self_check, out);
  if (command == "config check") return run_config_check(options.config_check, out);
  if (command == "calibrate") {
    return run_sibling_program("traygauge-calibrate", program.remaining());
  }
  if (command == "card") {
    std::vector<std::string> arguments = program.remaining();
    arguments.insert(arguments.begin(), command);
    return run_sibling_program("traygauge-card", arguments);
  }
  if (command == "hub") return run_sibling_program("traygauge-hub", {});
  if (command == "collect") return run_sibling_program("traygauge-collect", {});
  if (command == "record") return run_record(options.record, stop_on_signals(), out, error);
  if (command == "support") return run_support(options.support, out);
  if (command == "backup") return run_backup(options.backup, out);
  if (command == "restore") return run_restore(options.restore, out);
  if (command == "verify bodies") {
    std::vector<std::string> arguments = program.remaining();
    arguments.insert(arguments.begin(), {"verify", "bodies"});
    return run_sibling_program("traygauge-card", arguments);
  }
  if (command == "verify plan") return run_verify_plan(options.verify.plan, out);
  if (command == "verify run") return run_verify(options.verify.run, stop_on_signals(), out, error);
  if (command == "verify report") return run_verify_report(options.verify.report, out, error);
  return run_memory(options.memory, out);
}

}  // namespace

int run_command_line(int argument_count, const char* const* arguments, std::ostream& out,
                     std::ostream& error) {
  Program program("Traygauge measures the volume of the food on a tray from two pictures.", "traygauge");
  program.add_version(describe_build("traygauge"));
  Options options;
  add_measure_command(program, options.measure);
  add_evaluate_command(program, options.evaluate);
  add_segment_command(program, options.segment);
  add_enrol_command(program, options.enrol);
  add_memory_command(program, options.memory);
  add_network_command(program, options.network);
  add_station_command(program, options.station);
  add_check_command(program, options.check);
  add_config_command(program, options.config_check);
  add_self_check_command(program, options.self_check);
  add_setup_command(program, options.setup);
  add_record_command(program, options.record);
  add_support_command(program, options.support);
  add_backup_command(program, options.backup);
  add_restore_command(program, options.restore);
  add_verify_command(program, options.verify);
  add_calibrate_command(program);
  add_card_command(program);
  add_hub_command(program);
  add_collect_command(program);
  const auto run = [&] { return run_command(program, options, out, error); };
  return program.run(argument_count, arguments, run, out, error);
}

}  // namespace traygauge
