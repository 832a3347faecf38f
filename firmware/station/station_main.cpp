// `traygauge station` as a program of its own: what draws pictures stays out of its memory.
#include <malloc.h>

#include <CLI/CLI.hpp>
#include <iostream>

#include "firmware/command/program.hpp"
#include "firmware/station/recorded_captures.hpp"
#include "firmware/station/station_command.hpp"
#include "firmware/station/stop_signal.hpp"

namespace {

// Blocks of this size have pages of their own, which go back to the system when they are freed. glibc raises
// it to the largest block that was ever freed: from then on pictures lie in the heap, and what the start
// needed for a while stays between them: 6 MiB.
constexpr int kOwnPagesFrom_bytes = 128 * 1024;

}  // namespace

// NOLINTNEXTLINE(bugprone-exception-escape): options that contradict each other end the program at once
int main(int argument_count, char** arguments) {
  mallopt(M_MMAP_THRESHOLD, kOwnPagesFrom_bytes);
  CLI::App app("Waits for the button, measures the tray, reports; again.", "traygauge");
  app.require_subcommand(1);
  traygauge::StationCommand command;
  traygauge::add_station_command(app, command);
  const auto run = [&] {
    return traygauge::run_station(command, traygauge::open_recorded_captures, traygauge::stop_on_signals(),
                                  std::cout, std::cerr);
  };
  return traygauge::run_program(app, argument_count, arguments, run, std::cout, std::cerr);
}
