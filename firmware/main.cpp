#include <iostream>

#include "firmware/command/command_line.hpp"

int main(int argument_count, char** arguments) {
  return traygauge::run_command_line(argument_count, arguments, std::cout, std::cerr);
}
