// Pictures of an evaluation, for reports.
#pragma once

#include <string>

#include "firmware/evaluate/evaluation.hpp"

namespace traygauge {

// SVG documents. One without data says so.
std::string plot_signed_errors(const Evaluation& evaluation);  // the paper's Fig. 8 (a)
std::string plot_variation(const Evaluation& evaluation);      // Fig. 8 (b)
std::string plot_error_by_angle(const Evaluation& evaluation);
std::string plot_volumes(const Evaluation& evaluation);  // estimated against true

}  // namespace traygauge
