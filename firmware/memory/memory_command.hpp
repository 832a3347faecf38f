// `traygauge memory`: what the program reserves at start.
#pragma once

#include <iosfwd>
#include <string>

namespace traygauge {

class Program;

struct MemoryOptions {
  int width = 1600;
  int height = 1200;
  std::string profile;  // empty: the default
};

void add_memory_command(Program& program, MemoryOptions& options);

// A table of the estimator's parts, their sum, and the caller's frames apart. Returns the exit status.
int run_memory(const MemoryOptions& options, std::ostream& out);

}  // namespace traygauge
