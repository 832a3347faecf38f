// `traygauge network`: what the file of a network holds, and what it makes of a picture.
#pragma once

#include <iosfwd>
#include <string>

namespace traygauge {

class Program;

// As typed; empty where not given.
struct NetworkOptions {
  std::string file;
  std::string picture;
  std::string out;
};

void add_network_command(Program& program, NetworkOptions& options);

// Returns the exit status. Throws UsageError, InputError, OutputError before anything is printed to `out`.
int run_network(const NetworkOptions& options, std::ostream& out);

}  // namespace traygauge
