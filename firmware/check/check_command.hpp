// `traygauge check`: every device of a station, tried.
#pragma once

#include <iosfwd>
#include <string>

namespace traygauge {

class Program;

struct CheckOptions {
  std::string station;   // a station file
  double press_s = 0.0;  // 0: nobody is asked to press
};

void add_check_command(Program& program, CheckOptions& options);

// A line for each device. Exit status: all work, or some not. Throws InputError where the file is not as
// expected.
int run_check(const CheckOptions& options, std::ostream& out);

}  // namespace traygauge
