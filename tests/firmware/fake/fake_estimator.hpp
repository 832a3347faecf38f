// An estimator that answers what a test tells it to, and remembers what it was given.
#pragma once

#include <cstdint>
#include <vector>

#include "core/pipeline/estimator.hpp"

namespace traygauge {

struct FakeEstimator {
  // The answers.
  Status construction;
  Status second_view;  // of add_view
  Measurement measurement;

  // What it was given.
  LensModel lens;
  ReferenceCard card;
  std::vector<DishModel> dishes;
  EstimatorLimits limits;
  std::vector<ViewInput> views;
  std::uint64_t seed = 0;
  int estimates = 0;
};

// The one that every Estimator of the test program plays.
FakeEstimator& fake_estimator();

}  // namespace traygauge
