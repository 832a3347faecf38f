// What our programs share: reading the command line, and errors told once on one line.
#pragma once

#include <functional>
#include <iosfwd>

namespace CLI {  // NOLINT(readability-identifier-naming): CLI11's own
class App;
}

namespace traygauge {

// Parses the arguments, runs, and returns the exit status. Exceptions of either, and output that could not be
// written, become a line that begins with the app's name, and status 2.
int run_program(CLI::App& app, int argument_count, const char* const* arguments,
                const std::function<int()>& run, std::ostream& out, std::ostream& error);

}  // namespace traygauge
