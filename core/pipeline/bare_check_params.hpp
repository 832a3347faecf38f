// The parameters of what bare table and bare glaze say.
#pragma once

#include <cstddef>

#include "core/stereo/surface_agreement.hpp"

namespace traygauge {

struct BareCheckParams {
  SurfaceAgreementParams agreement;
  // Table this far around the card's print: beyond the card's own edge, and as far as it is surely the same.
  double card_margin_mm = 6.0;
  double around_card_mm = 20.0;
  double table_step_mm = 1.5;            // finer than the grain that is compared, which is 2 mm
  std::size_t max_glaze_samples = 1500;  // of each band of a dish
};

}  // namespace traygauge
