// `traygauge station` as a program of its own: what draws pictures stays out of its memory.
#include <CLI/CLI.hpp>
#include <iostream>

#include "firmware/command/program.hpp"
#include "firmware/station/recorded_captures.hpp"
#include "firmware/station/station_command.hpp"
#include "firmware/station/stop_signal.hpp"

int main(int argument_count, char** arguments) {
  using namespace traygauge;
  CLI::App app("Waits for the button, measures the tray, reports; again.", "traygauge");
  app.require_subcommand(1);
  StationCommand command;
  add_station_command(app, command);
  const auto run = [&] {
    return run_station(command, open_recorded_captures, stop_on_signals(), std::cout, std::cerr);
  };
  return run_program(app, argument_count, arguments, run, std::cout, std::cerr);
}
