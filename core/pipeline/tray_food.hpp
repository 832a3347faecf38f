// Food that lies beside the dishes, on the tray or on a napkin: measured over the ground around it.
#pragma once

#include "core/pipeline/surface_measurement.hpp"

namespace traygauge {

// Appends the items that lie on no dish to the workspace's, and the height map of each of their places to its
// surfaces.
void measure_tray_food(const TrayAtWork& tray);

}  // namespace traygauge
