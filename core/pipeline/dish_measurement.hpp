// One dish, from where it stands to the volumes of what lies on it.
#pragma once

#include <cstddef>

#include "core/pipeline/surface_measurement.hpp"

namespace traygauge {

// Appends the items on dish `index` of the tray to the workspace's, and its height map to its surfaces. What
// fails here fails for all of them: every item then carries that status.
void measure_dish(const TrayAtWork& tray, std::size_t index);

}  // namespace traygauge
