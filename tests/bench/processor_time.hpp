// Time that a piece of work takes: the processor's, and the best of several rounds, because other programs
// only make it longer.
#pragma once

#include <algorithm>
#include <ctime>
#include <limits>

namespace traygauge::test {

inline double processor_ms() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

template <class Work>
double best_ms(int rounds, Work&& work) {
  double best = std::numeric_limits<double>::infinity();
  for (int round = 0; round < rounds; ++round) {
    const double begun_ms = processor_ms();
    work();
    best = std::min(best, processor_ms() - begun_ms);
  }
  return best;
}

}  // namespace traygauge::test
