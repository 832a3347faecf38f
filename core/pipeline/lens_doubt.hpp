// Card and dishes contradict each other: would they agree through another lens? A focal length of another
// mode of the sensor, or a distortion that was left out, looks like a card or a dish that moved or lies
// elsewhere.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "core/geometry/camera.hpp"
#include "core/pipeline/measurement.hpp"

namespace traygauge {

// What another lens has otherwise.
struct LensChange {
  double focal_ratio = 1.0;
  double k1 = 0.0;  // added

  LensModel of(LensModel lens) const;
};

struct LensDoubtParams {
  // Chosen on the captures (tests/evaluation/experiments.md).
  std::array<LensChange, 6> tried = {{{0.9}, {0.95}, {1.05}, {1.1}, {1.0, -0.1}, {1.0, 0.1}}};
  double focal_step = 0.05;  // from one of them to the next
  // Of the card's scale by each dish, in per cent. Pairs through their right lens reach 0.16, the errors
  // above 0.4 and more.
  double max_scale_percent = 0.3;
};

// Whether a wrong lens may be why something was refused or doubted.
bool may_be_the_lens(const Measurement& measurement);

// Where nothing contradicts anything, and a dish confirms the card's scale: by how much they still differ.
std::optional<double> scale_if_all_agrees(const Measurement& measurement);

// A refused pair and its `items` get the status lens_does_not_fit. A pair that was measured, in part at
// least, gets the warning: a slip of half a millimetre is sometimes explained by a lens as well. Adds the
// check focal_percent where the focal length is what changed.
void blame_lens(const LensChange& change, const LensDoubtParams& params, std::span<ItemResult> items,
                Measurement& measurement);

}  // namespace traygauge
