#include <iostream>

#include "firmware/simulate/simulate_command.hpp"

int main(int argument_count, char** arguments) {
  return traygauge::run_simulate(argument_count, arguments, std::cout, std::cerr);
}
