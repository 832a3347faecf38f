// `traygauge evaluate`.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace traygauge {

class Program;

struct EvaluateOptions {
  std::string set;
  std::string profile;
  std::string labels;
  std::string out;
  std::string config;
  int runs = 8;
  int jobs = 1;
  std::vector<std::string> settings;
  bool json = false;
  bool stages = false;
  bool list_parameters = false;
};

void add_evaluate_command(Program& program, EvaluateOptions& options);

// Returns the exit status: 0 when at least one item was measured, 1 when none. Throws UsageError, InputError,
// OutputError, PlotError.
int run_evaluate(const EvaluateOptions& options, std::ostream& out, std::ostream& error);

}  // namespace traygauge
