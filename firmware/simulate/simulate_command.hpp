// traygauge-simulate: renders scenes into captures.
#pragma once

#include <iosfwd>

namespace traygauge {

// Returns the exit status.
int run_simulate(int argument_count, const char* const* arguments, std::ostream& out, std::ostream& error);

}  // namespace traygauge
