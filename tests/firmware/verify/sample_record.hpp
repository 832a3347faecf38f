// Records of acceptance tests that nobody ran.
#pragma once

#include <string>
#include <vector>

#include "firmware/verify/verify_record.hpp"

namespace traygauge {

// Bodies of 100 and 200 ml, exactly known: "a" and "b", at two places and angles, and two repeats of "b".
VerifyHeader sample_header();

VerifyScan measured_scan(const std::string& step, double volume_ml, double sigma_ml = 1.0);
VerifyScan refused_scan(const std::string& step);

// As good as a test can be that half an hour allows: five bodies, six scans each, ten repeats; each volume is
// off by what `error_percent` says in turn, with a sigma of 2 %.
VerifyRecord large_record(const std::vector<double>& error_percent);

}  // namespace traygauge
