// Runs the command line as a person would, in this process, on the fake estimator.
#pragma once

#include <string>
#include <vector>

namespace traygauge {

struct CommandResult {
  int status = 0;
  std::string out;
  std::string error;
};

CommandResult run(const std::vector<std::string>& arguments);

}  // namespace traygauge
