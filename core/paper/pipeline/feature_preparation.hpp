// The salient points of a view: over the whole picture, and on the card at the scale of its pattern.
#pragma once

#include <span>

#include "core/base/status.hpp"
#include "core/paper/pipeline/view_preparation.hpp"
#include "core/pipeline/configuration.hpp"

namespace traygauge {

// Detects, describes and undistorts; call after prepare_picture. Where the card is labelled, its part of the
// picture is searched apart, enlarged. Points whose pixel the lens model cannot invert are dropped.
// too_few_features when the picture has next to none.
Status prepare_features(const Configuration& configuration, PreparationWorkspace& workspace,
                        PreparedView& view);

// The largest scale up to `wanted` at which a picture, scaled, can be searched in the memory.
double fit_search_scale(double wanted, int width, int height, const EstimatorLimits& limits);

// Takes features from elsewhere instead, in pixels of the stored picture.
Status take_features(std::span<const Keypoint> keypoints, std::span<const Descriptor> descriptors,
                     const ViewParams& params, PreparedView& view);

}  // namespace traygauge
