// `traygauge segment`.
#pragma once

#include <iosfwd>
#include <string>

namespace traygauge {

class Program;

// As typed; empty where not given.
struct SegmentOptions {
  std::string capture;
  std::string pair;
  std::string config;
  std::string picture;
  std::string out;
  int items = 0;  // as a menu says; 0: not known
  bool json = false;
};

void add_segment_command(Program& program, SegmentOptions& options);

// Returns the exit status: 0 where food was found in both views, 1 where not. Throws UsageError, InputError,
// OutputError before anything is printed to `out`.
int run_segment(const SegmentOptions& options, std::ostream& out);

}  // namespace traygauge
