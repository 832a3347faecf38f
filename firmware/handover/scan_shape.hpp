// What a measured tray looks like, for who shows it: heights from above, and outlines.
#pragma once

#include <string>
#include <string_view>

#include "core/pipeline/measurement.hpp"

namespace traygauge {

// JSON as GET /api/v1/scans/{id}/shape answers it (firmware/api/openapi.yaml). Empty where no surface was
// measured. Coarser than what was measured: cells of 2 to 3 mm, of which one dish has some 10,000.
std::string compose_shape(const Measurement& measurement, std::string_view id);

}  // namespace traygauge
