#include <iostream>

#include "firmware/base/build_info.hpp"
#include "firmware/base/exit_status.hpp"
#include "firmware/built_commit.hpp"
#include "firmware/simulate/simulate_command.hpp"

namespace {

// What the renderer is compiled for, see simulator/render/CMakeLists.txt.
bool has_processor_all() {
#ifdef TRAYGAUGE_NEEDS_AVX2
  return static_cast<bool>(__builtin_cpu_supports("avx2"));
#else
  return true;
#endif
}

}  // namespace

int main(int argument_count, char** arguments) {
  traygauge::set_built_commit(traygauge::kCommit);
  if (!has_processor_all()) {
    std::cerr << "traygauge-simulate: this processor lacks AVX2, which the renderer was built for; run it on "
                 "one from 2015 or later, or build it with -DTRAYGAUGE_AVX2=OFF\n";
    return traygauge::kExitWrongUse;
  }
  return traygauge::run_simulate(argument_count, arguments, std::cout, std::cerr);
}
