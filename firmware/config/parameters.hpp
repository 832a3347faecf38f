// Stage parameters by name, for experiments: "best.surface.levels=2".
#pragma once

#include <string>
#include <vector>

#include "core/pipeline/configuration.hpp"

namespace traygauge {

// Sets one parameter of `configuration`. Throws UsageError: unknown name, a parameter that the profile of
// `configuration` does not read, or a value of another type or outside of its range.
void set_parameter(Configuration& configuration, const std::string& assignment);

// All names with their values, in the order of the stages, and what else each may be: "name=value  (…)".
// Before those of each profile stands a line "# profile …".
std::vector<std::string> list_parameters(const Configuration& configuration);

}  // namespace traygauge
