// An estimator that answers what a test tells it to, and remembers what it was given.
#pragma once

#include <cstdint>
#include <vector>

#include "core/paper/pipeline/estimator.hpp"
#include "core/pipeline/tray_estimator.hpp"

namespace traygauge {

struct FakeEstimator {
  // The answers.
  Status construction;
  Status second_view;  // of add_view
  Measurement measurement;
  paper::WorkingPictures pictures;  // of profile paper

  // What it was given.
  LensModel lens;
  ReferenceCard card;
  std::vector<DishModel> dishes;
  FrameLimits limits;
  std::vector<ViewInput> views;
  std::uint64_t seed = 0;
  int estimates = 0;
};

// The one that every estimator of the test program plays, of either profile.
FakeEstimator& fake_estimator();

}  // namespace traygauge
