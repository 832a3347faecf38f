// `traygauge collect` as a program of its own: it holds no device and nothing of the measurement.
#include <iostream>

#include "firmware/base/build_info.hpp"
#include "firmware/built_commit.hpp"
#include "firmware/collect/collect_command.hpp"
#include "firmware/command/confinement.hpp"
#include "firmware/command/program.hpp"
#include "firmware/command/stop_signal.hpp"

// NOLINTNEXTLINE(bugprone-exception-escape): options that contradict each other end the program at once
int main(int argument_count, char** arguments) {
  traygauge::set_built_commit(traygauge::kCommit);
  traygauge::Program program("Stores what many hubs publish.", "traygauge");
  traygauge::CollectCommand command;
  traygauge::add_collect_options(program, command);
  const auto run = [&] {
    if (const auto confined = traygauge::confine_hub(); !confined.ok())
      std::cerr << confined.failure() << std::endl;
    return traygauge::run_collect(command, traygauge::stop_on_signals(), std::cout, std::cerr);
  };
  return program.run(argument_count, arguments, run, std::cout, std::cerr);
}
