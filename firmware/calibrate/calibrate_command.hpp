// `traygauge calibrate`: the lens from pictures of a chessboard, the arm from captures of the card.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace traygauge {

class Program;

struct CalibrateOptions {
  std::string station;  // a station file
  std::string board;    // "9x6": inner corners
  std::vector<std::string> inputs;
  bool second = false;   // the lens of the second camera
  bool dry_run = false;  // writes nothing
  bool force = false;    // writes what is not good enough, too
};

void add_calibrate_commands(Program& program, CalibrateOptions& options);

// Exit status: 0 calibrated, 1 what came of it is not good enough and was not written. Throws UsageError,
// InputError, OutputError.
int run_calibrate_lens(const CalibrateOptions& options, std::ostream& out);
int run_calibrate_arm(const CalibrateOptions& options, std::ostream& out);

}  // namespace traygauge
