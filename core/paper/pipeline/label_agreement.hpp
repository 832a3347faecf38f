// Do the outlines of both views belong to the same scene?
#pragma once

#include <cstdint>
#include <span>

#include "core/base/status.hpp"
#include "core/geometry/triangulation.hpp"
#include "core/image_view/image_view.hpp"

namespace traygauge::paper {

struct LabelAgreementParams {
  // Share of food pixels whose place in the other view carries the same label. Exact outlines reach 0.95 and
  // more, what is missing being hidden there; hand-drawn ones about 0.9; labels of another picture below 0.7.
  double min_fraction = 0.80;
  int step_px = 2;  // every so many pixels of the working picture are looked at
};

// Share of the food's pixels that agree, by the depth of the reference view (NaN where unknown, then not
// counted).
double measure_label_agreement(ImageView<const std::uint8_t> reference_labels,
                               ImageView<const std::uint8_t> other_labels, ImageView<const float> depth_mm,
                               const CameraPair& cameras, const LabelAgreementParams& params);

}  // namespace traygauge::paper
