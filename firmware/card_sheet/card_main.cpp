#include <iostream>

#include "firmware/base/build_info.hpp"
#include "firmware/built_commit.hpp"
#include "firmware/card_sheet/body_command.hpp"
#include "firmware/card_sheet/card_command.hpp"
#include "firmware/command/program.hpp"

// NOLINTNEXTLINE(bugprone-exception-escape): options that contradict each other end the program at once
int main(int argument_count, char** arguments) {
  traygauge::set_built_commit(traygauge::kCommit);
  traygauge::Program program("Makes what is printed: the reference card, the proof bodies.", "traygauge");
  traygauge::CardOptions card;
  traygauge::BodyOptions bodies;
  traygauge::add_card_command(program, card);
  traygauge::add_bodies_command(program, bodies);
  const auto run = [&] {
    return program.chosen() == "card" ? traygauge::run_card(card, std::cout)
                                      : traygauge::run_bodies(bodies, std::cout);
  };
  return program.run(argument_count, arguments, run, std::cout, std::cerr);
}
