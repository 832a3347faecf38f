#include <CLI/CLI.hpp>
#include <iostream>

#include "firmware/calibrate/calibrate_command.hpp"
#include "firmware/command/program.hpp"

// NOLINTNEXTLINE(bugprone-exception-escape): options that contradict each other end the program at once
int main(int argument_count, char** arguments) {
  CLI::App app("Calibrates a station's lens and arm.", "traygauge calibrate");
  app.require_subcommand(1);
  traygauge::CalibrateOptions options;
  traygauge::add_calibrate_commands(app, options);
  const auto run = [&] {
    return app.got_subcommand("lens") ? traygauge::run_calibrate_lens(options, std::cout)
                                      : traygauge::run_calibrate_arm(options, std::cout);
  };
  return traygauge::run_program(app, argument_count, arguments, run, std::cout, std::cerr);
}
