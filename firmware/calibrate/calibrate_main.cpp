#include <iostream>

#include "firmware/base/build_info.hpp"
#include "firmware/built_commit.hpp"
#include "firmware/calibrate/calibrate_command.hpp"
#include "firmware/command/program.hpp"

// NOLINTNEXTLINE(bugprone-exception-escape): options that contradict each other end the program at once
int main(int argument_count, char** arguments) {
  traygauge::set_built_commit(traygauge::kCommit);
  traygauge::Program program("Calibrates a station's lens and arm.", "traygauge calibrate");
  traygauge::CalibrateOptions options;
  traygauge::add_calibrate_commands(program, options);
  const auto run = [&] {
    return program.chosen() == "lens" ? traygauge::run_calibrate_lens(options, std::cout)
                                      : traygauge::run_calibrate_arm(options, std::cout);
  };
  return program.run(argument_count, arguments, run, std::cout, std::cerr);
}
