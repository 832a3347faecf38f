// The salient points of a view: over the whole picture, and on the card at the scale of its pattern.
#pragma once

#include <span>

#include "core/base/status.hpp"
#include "core/paper/pipeline/configuration.hpp"
#include "core/paper/pipeline/view_preparation.hpp"

namespace traygauge::paper {

// Detects, describes and undistorts; call after prepare_picture. Where the card is labelled, its part of the
// picture is searched apart, enlarged. Points whose pixel the lens model cannot invert are dropped.
// too_few_features when the picture has next to none.
Status prepare_features(const Configuration& configuration, PreparationWorkspace& workspace,
                        PreparedView& view);

// The largest scale up to `wanted` at which a picture, scaled, can be searched in the memory.
double fit_search_scale(double wanted, int width, int height, const Configuration& configuration);

}  // namespace traygauge::paper
