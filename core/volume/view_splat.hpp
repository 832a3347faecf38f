// Rasterises what one view sees into a height map of its own.
#pragma once

#include <span>

#include "core/volume/height_map.hpp"

namespace traygauge {

// Overwrites `map` with the view's uppermost patches: triangles between neighbouring samples, cut where they
// span an occlusion. Half a sample beyond its last sample a surface ends, the silhouette's mean place.
// The bare dish is taken at every second sample. `corners` holds three rows of the view.
void splat_view(const SurfaceGrid& view, const HeightMapParams& params,
                std::span<HeightMapWorkspace::Corner> corners, HeightMap& map);

}  // namespace traygauge
