// Parameters that may be set by name: "geometry.max_angle_deg=45". Of the product, what a site may have
// reasons to decide; of profile paper, what its authors left open or compared.
#pragma once

#include <string>
#include <vector>

#include "firmware/config/profile.hpp"

namespace traygauge {

// Sets one parameter of the chosen profile. Throws UsageError: unknown name, a parameter that the profile
// does not read, or a value of another type or outside of its range.
void set_parameter(ProfileParameters& parameters, const std::string& assignment);

// All names with their values, and what else each may be: "name=value  (…)". Before those of each profile
// stands a line "# profile …".
std::vector<std::string> list_parameters(const ProfileParameters& parameters);

}  // namespace traygauge
