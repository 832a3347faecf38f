// `traygauge measure`.
#pragma once

#include <iosfwd>
#include <string>

namespace traygauge {

class Program;

// As typed; empty where not given.
struct MeasureOptions {
  std::string capture;
  std::string pair;
  std::string labels;
  std::string profile;
  std::string seed;
  std::string config;
  std::string picture;
  std::string mesh;
  int items = 0;  // as a menu says; 0: not known
  bool json = false;
};

// Adds the command and its options.
void add_measure_command(Program& program, MeasureOptions& options);

// Returns the exit status. Throws UsageError, InputError, OutputError before anything is printed to `out`.
int run_measure(const MeasureOptions& options, std::ostream& out, std::ostream& error);

}  // namespace traygauge
