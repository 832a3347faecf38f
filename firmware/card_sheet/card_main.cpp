#include <iostream>

#include "firmware/card_sheet/card_command.hpp"
#include "firmware/command/program.hpp"

// NOLINTNEXTLINE(bugprone-exception-escape): options that contradict each other end the program at once
int main(int argument_count, char** arguments) {
  traygauge::Program program("Makes the reference card.", "traygauge");
  traygauge::CardOptions options;
  traygauge::add_card_command(program, options);
  const auto run = [&] { return traygauge::run_card(options, std::cout); };
  return program.run(argument_count, arguments, run, std::cout, std::cerr);
}
