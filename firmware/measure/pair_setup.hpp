// What a measurement of one pair depends on beside its pictures, as a capture states it.
#pragma once

#include <array>
#include <vector>

#include "core/pipeline/configuration.hpp"
#include "simulator/capture/capture.hpp"

namespace traygauge {

LensModel lens_of(const CameraDescription& camera);
DishModel dish_of(const DishDescription& dish);

// Caps for frames of these sizes, everything else at its default.
EstimatorLimits limits_for(PictureSize first, PictureSize second);

struct PairSetup {
  std::array<LensModel, 2> lenses;
  CardDescription card;
  Picture pattern;  // the card's print in grey
  std::vector<DishModel> dishes;
};

// `dishes`: those of the tray, or candidates for its only one. Reads the pattern; throws InputError.
PairSetup set_up_pair(const Capture& capture, std::array<int, 2> pair,
                      const std::vector<DishDescription>& dishes);

// `parameters` carries those of the stages; its camera (the first view's), card, dishes and frame size are
// replaced. The result refers to pattern and dishes of `setup`.
Configuration configure(const PairSetup& setup, const Configuration& parameters = {});

}  // namespace traygauge
