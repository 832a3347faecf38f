// The synthetic tray through the estimator of profile paper.
#pragma once

#include "core/paper/pipeline/estimator.hpp"
#include "tests/core/pipeline/measuring_bench.hpp"

namespace traygauge::paper {

using MeasuringBench = BenchOf<Estimator, Configuration>;

inline Configuration configuration_of(const TrayScene& scene) {
  return scene.configuration<Configuration>();
}

}  // namespace traygauge::paper
