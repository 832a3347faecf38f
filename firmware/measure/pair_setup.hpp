// What a measurement of one pair depends on beside its pictures, as a capture states it.
#pragma once

#include <array>
#include <vector>

#include "core/pipeline/configuration.hpp"
#include "simulator/capture/capture.hpp"

namespace traygauge {

LensModel lens_of(const CameraDescription& camera);
DishModel dish_of(const DishDescription& dish);
// It refers to `pattern`.
ReferenceCard card_of(const CardDescription& card, const Picture& pattern);

// Caps for frames of these sizes, everything else at its default.
FrameLimits limits_for(PictureSize first, PictureSize second);

struct PairSetup {
  std::array<LensModel, 2> lenses;
  CardDescription card;
  Picture pattern;  // the card's print in grey
  std::vector<DishModel> dishes;
};

// `dishes`: those of the tray, or candidates for its only one. Reads the pattern; throws InputError.
PairSetup set_up_pair(const Capture& capture, std::array<int, 2> pair,
                      const std::vector<DishDescription>& dishes);

// Fills in camera (the first view's), card, dishes and frame size; they refer to pattern and dishes of
// `setup`.
void describe_tray(const PairSetup& setup, TraySetup& tray);

// `parameters` of the stages, with the tray filled in. `Config` is that of either profile.
template <class Config = Configuration>
Config configure(const PairSetup& setup, Config parameters = {}) {
  describe_tray(setup, parameters);
  return parameters;
}

}  // namespace traygauge
