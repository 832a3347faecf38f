#include <iostream>

#include "firmware/base/exit_status.hpp"
#include "firmware/simulate/simulate_command.hpp"

namespace {

// What the renderer is compiled for, see simulator/render/CMakeLists.txt.
bool has_processor_all() {
#if defined(__x86_64__)
  return static_cast<bool>(__builtin_cpu_supports("sse4.1"));
#else
  return true;
#endif
}

}  // namespace

int main(int argument_count, char** arguments) {
  if (!has_processor_all()) {
    std::cerr << "traygauge-simulate: this processor lacks SSE 4.1, which the renderer needs; run it on one "
                 "from 2008 or later\n";
    return traygauge::kExitWrongUse;
  }
  return traygauge::run_simulate(argument_count, arguments, std::cout, std::cerr);
}
