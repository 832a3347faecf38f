// Stage parameters by name, for experiments: "stereo.window_radius_px=3".
#pragma once

#include <string>
#include <vector>

#include "core/estimator/configuration.hpp"

namespace traygauge {

// Sets one parameter of `configuration`. Throws UsageError: unknown name, or a value of another type.
void set_parameter(Configuration& configuration, const std::string& assignment);

// All names with their values, in the order of the stages.
std::vector<std::string> list_parameters(const Configuration& configuration);

}  // namespace traygauge
