#include <iostream>
#include <string_view>

#include "firmware/base/build_info.hpp"
#include "firmware/built_commit.hpp"
#include "firmware/command/command_line.hpp"
#include "firmware/command/sibling_program.hpp"

int main(int argument_count, char** arguments) {
  traygauge::set_built_commit(traygauge::kCommit);
  // The same command without what other commands load. Where that program was not installed, this one does
  // it.
  if (argument_count > 1 && std::string_view(arguments[1]) == "station")
    traygauge::become_sibling_program("traygauge-station", arguments);
  if (argument_count > 1 && std::string_view(arguments[1]) == "hub")
    traygauge::become_sibling_program("traygauge-hub", arguments);
  if (argument_count > 1 && std::string_view(arguments[1]) == "collect")
    traygauge::become_sibling_program("traygauge-collect", arguments);
  return traygauge::run_command_line(argument_count, arguments, std::cout, std::cerr);
}
