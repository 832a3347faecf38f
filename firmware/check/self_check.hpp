// `traygauge self-check`: whether these programs can go on where others stopped, without a look at the
// devices.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

namespace traygauge {

class Program;

struct SelfCheckOptions {
  std::string station;  // a station file
  std::string capture;  // with truth.json; empty: the one that came with the program
};

void add_self_check_command(Program& program, SelfCheckOptions& options);

// A line for each part, "ok    PART: …" or "FAIL  PART: …": measurement (the station measures a capture and
// is compared with its truth), configuration, hub (its configuration and the store's version), journal. The
// package compares these words before it restarts the units. As root it starts station and hub as the users
// of their units, where there are such. Exit status: all good, or some not. Throws InputError where no
// capture came with the program.
int run_self_check(const SelfCheckOptions& options, std::ostream& out);

}  // namespace traygauge
