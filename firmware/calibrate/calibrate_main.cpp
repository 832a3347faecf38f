#include <CLI/CLI.hpp>
#include <iostream>

#include "firmware/calibrate/calibrate_command.hpp"
#include "firmware/command/program.hpp"

int main(int argument_count, char** arguments) {
  using namespace traygauge;
  CLI::App app("Calibrates a station's lens and arm.", "traygauge calibrate");
  app.require_subcommand(1);
  CalibrateOptions options;
  add_calibrate_commands(app, options);
  const auto run = [&] {
    return app.got_subcommand("lens") ? run_calibrate_lens(options, std::cout)
                                      : run_calibrate_arm(options, std::cout);
  };
  return run_program(app, argument_count, arguments, run, std::cout, std::cerr);
}
