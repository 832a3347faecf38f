// `traygauge enrol-dish`.
#pragma once

#include <iosfwd>
#include <string>

namespace traygauge {

class Program;

// As typed; empty where not given.
struct EnrolOptions {
  std::string capture;
  std::string style;
  std::string out;
  std::string size;  // by a ruler; the outlines are then found
  std::string pair;
  std::string seed;
  std::string config;
  bool force = false;
  bool json = false;
};

void add_enrol_command(Program& program, EnrolOptions& options);

// Returns the exit status: 0 when the dish was written, 1 when it was not measurable. Throws UsageError,
// InputError, OutputError.
int run_enrol(const EnrolOptions& options, std::ostream& out);

}  // namespace traygauge
