// Do the reported times hold against a clock outside of the estimator?
#pragma once

#include "tests/bench/scene.hpp"

namespace traygauge::bench {

// Prints timing_ms.total beside an outside clock around add_view and estimate (medians of several runs), and
// the time of each stage; false when they differ by more than 5 %.
bool check_reported_time(const Scene& scene);
bool check_reported_paper_time(const Scene& scene);

}  // namespace traygauge::bench
