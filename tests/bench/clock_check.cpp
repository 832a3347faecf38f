#include "tests/bench/clock_check.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>

namespace traygauge::bench {
namespace {

constexpr std::size_t kRuns = 7;
constexpr double kTolerance = 0.05;

using Times = std::array<double, kRuns>;

double median(Times times) {
  std::nth_element(times.begin(), times.begin() + kRuns / 2, times.end());
  return times[kRuns / 2];
}

template <class AnySession>
bool check(const Scene& scene) {
  AnySession session(scene);
  Times outside_ms{};
  Times reported_ms{};
  Times share{};
  std::array<Times, kStageCount> stage_ms{};
  for (std::size_t run = 0; run < kRuns; ++run) {
    const auto start = std::chrono::steady_clock::now();
    const Measurement& measurement = session.measure();
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;
    if (!measurement.status.ok()) {
      std::printf("%s, %s: not measured: %s\n", scene.name.c_str(), name_of<AnySession>(),
                  sentence(measurement.status.code()));
      return false;
    }
    outside_ms[run] = elapsed.count();
    reported_ms[run] = measurement.total_ms;
    share[run] = measurement.total_ms / elapsed.count();
    for (std::size_t i = 0; i < kStageCount; ++i) stage_ms[i][run] = measurement.stage_ms[i];
  }
  const double deviation = std::abs(median(share) - 1.0);
  std::printf("%s, %s: outside clock %.1f ms, reported total %.1f ms, apart by %.2f %% (at most %.0f %%)\n ",
              scene.name.c_str(), name_of<AnySession>(), median(outside_ms), median(reported_ms),
              100.0 * deviation, 100.0 * kTolerance);
  for (std::size_t i = 0; i < kStageCount; ++i) {
    std::printf(" %s %.1f", name(static_cast<Stage>(i)), median(stage_ms[i]));
  }
  std::printf("\n");
  return deviation <= kTolerance;
}

}  // namespace

bool check_reported_time(const Scene& scene) {
  return check<Session>(scene);
}

bool check_reported_paper_time(const Scene& scene) {
  return check<PaperSession>(scene);
}

}  // namespace traygauge::bench
