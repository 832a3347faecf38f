#include "firmware/command/program.hpp"

#include <CLI/CLI.hpp>
#include <exception>
#include <new>
#include <ostream>
#include <string>

#include "firmware/base/exit_status.hpp"
#include "simulator/capture/input_error.hpp"

namespace traygauge {

int run_program(CLI::App& app, int argument_count, const char* const* arguments,
                const std::function<int()>& run, std::ostream& out, std::ostream& error) {
  const auto fail = [&](const std::string& text) {
    error << app.get_name() << ": " << printable(text) << "\n";
    return kExitWrongUse;
  };
  try {
    app.parse(argument_count, arguments);
    const int status = run();
    out.flush();
    return out ? status : fail("the result could not be written to standard output");
  } catch (const CLI::ParseError& problem) {
    if (problem.get_exit_code() == 0) return app.exit(problem, out, error);  // --help, --version
    return fail(std::string(problem.what()) + "; see " + app.get_name() + " --help");
  } catch (const std::bad_alloc&) {
    return fail("too little memory for pictures of this size; see traygauge memory");
  } catch (const std::exception& problem) {  // UsageError, InputError, OutputError
    return fail(problem.what());
  }
}

}  // namespace traygauge
