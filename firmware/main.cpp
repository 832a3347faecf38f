#include <iostream>
#include <string_view>

#include "firmware/command/command_line.hpp"
#include "firmware/command/sibling_program.hpp"

int main(int argument_count, char** arguments) {
  using namespace traygauge;
  // The same command without what other commands load. Where that program was not installed, this one does
  // it.
  if (argument_count > 1 && std::string_view(arguments[1]) == "station")
    become_sibling_program("traygauge-station", arguments);
  return run_command_line(argument_count, arguments, std::cout, std::cerr);
}
