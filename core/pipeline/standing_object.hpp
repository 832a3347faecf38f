// Something high that stands beside the dishes: a bowl or cup that nobody described, a glass, a bottle. What
// is in it is not measured, which a person has to know.
#pragma once

#include <cstdint>

#include "core/card/card_size.hpp"
#include "core/pipeline/scene_geometry.hpp"
#include "core/pipeline/standing_object_params.hpp"

namespace traygauge {

struct StandingObject {
  bool is_seen = false;
  double height_mm = 0.0;
  double sigma_mm = 0.0;  // of the steps in which heights are tried
};

// The one that shows most. Only what both pictures label so is looked at.
StandingObject find_standing_object(const ViewPair& views, const SceneGeometry& geometry,
                                    const CardModelSize& card, const StandingObjectParams& params,
                                    std::uint8_t label = kBackgroundLabel);

}  // namespace traygauge
