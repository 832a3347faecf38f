// Two views of a capture of an empty dish through the surveyor.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/enrolment/dish_survey.hpp"
#include "firmware/base/aligned_block.hpp"
#include "firmware/enrol/found_outlines.hpp"
#include "firmware/measure/pair_setup.hpp"
#include "simulator/capture/capture.hpp"

namespace traygauge {

// Loads the pictures of the pair, smaller where they are larger than what is measured (view_reduction.hpp).
// Throws InputError; also when the labels show anything but one dish and the card.
class EmptyDish {
 public:
  // With `ruled`, the outlines are found; without, they are the capture's labels.
  EmptyDish(const Capture& capture, std::array<int, 2> pair, const std::optional<RuledDish>& ruled);

  const DishSurvey& survey(std::uint64_t seed);

 private:
  std::array<LoadedView, 2> views_;
  PairSetup setup_;
  AlignedBlock block_;
  DishSurveyor surveyor_;
};

// The dish as it is written down: to 0.01 mm.
DishDescription describe_dish(const DishModel& dish, const std::string& style);

}  // namespace traygauge
