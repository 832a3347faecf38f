// `traygauge station` as a program of its own: what draws pictures stays out of its memory.
#include <malloc.h>

#include <iostream>

#include "firmware/base/build_info.hpp"
#include "firmware/built_commit.hpp"
#include "firmware/command/confinement.hpp"
#include "firmware/command/program.hpp"
#include "firmware/command/stop_signal.hpp"
#include "firmware/station/open_captures.hpp"
#include "firmware/station/station_command.hpp"

namespace {

// Blocks of this size have pages of their own, which go back to the system when they are freed. glibc raises
// it to the largest block that was ever freed: from then on pictures lie in the heap, and what the start
// needed for a while stays between them: 6 MiB.
constexpr int kOwnPagesFrom_bytes = 128 * 1024;

}  // namespace

// NOLINTNEXTLINE(bugprone-exception-escape): options that contradict each other end the program at once
int main(int argument_count, char** arguments) {
  traygauge::set_built_commit(traygauge::kCommit);
  mallopt(M_MMAP_THRESHOLD, kOwnPagesFrom_bytes);
  traygauge::Program program("Waits for the button, measures the tray, reports; again.", "traygauge");
  traygauge::StationCommand command;
  traygauge::add_station_command(program, command);
  const auto run = [&] {
    if (const auto confined = traygauge::confine_station(); !confined.ok())
      std::cerr << confined.failure() << std::endl;
    return traygauge::run_station(command, traygauge::open_recorded_captures, traygauge::stop_on_signals(),
                                  std::cout, std::cerr);
  };
  return program.run(argument_count, arguments, run, std::cout, std::cerr);
}
