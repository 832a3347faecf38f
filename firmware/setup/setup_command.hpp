// `traygauge setup`: from a station file with wires to a measured tray.
#pragma once

#include <iosfwd>
#include <string>

#include "firmware/setup/setup_site.hpp"

namespace traygauge {

class Program;

struct SetupOptions {
  std::string station;  // a station file
  std::string step;     // that one alone; empty: all, in their order
};

void add_setup_command(Program& program, SetupOptions& options);

// Exit status: 0 all steps are done, 1 some were left out or the person ended. Throws UsageError, InputError,
// OutputError.
int run_setup(const SetupOptions& options, const SetupTools& tools, std::istream& in, std::ostream& out);

}  // namespace traygauge
