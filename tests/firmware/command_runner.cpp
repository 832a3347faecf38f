#include "tests/firmware/command_runner.hpp"

#include <sstream>

#include "firmware/command/command_line.hpp"

namespace traygauge {

CommandResult run(const std::vector<std::string>& arguments) {
  std::vector<const char*> pointers = {"traygauge"};
  for (const std::string& argument : arguments) pointers.push_back(argument.c_str());
  std::ostringstream out;
  std::ostringstream error;
  CommandResult result;
  result.status = run_command_line(static_cast<int>(pointers.size()), pointers.data(), out, error);
  result.out = out.str();
  result.error = error.str();
  return result;
}

}  // namespace traygauge
