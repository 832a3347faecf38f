// The command line of `traygauge`.
#pragma once

#include <iosfwd>

namespace traygauge {

// Runs the command that is typed: results go to `out`, errors as one line to `error`. Returns the exit
// status.
int run_command_line(int argument_count, const char* const* arguments, std::ostream& out,
                     std::ostream& error);

}  // namespace traygauge
