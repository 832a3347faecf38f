// Under which conditions an acceptance test runs, for its certificate.
#pragma once

#include <string>

#include "firmware/verify/verify_record.hpp"
#include "simulator/capture/capture.hpp"

namespace traygauge {

struct VerifyRunOptions;
struct StationFile;

// Program, time, plan and what the tester states.
VerifyHeader begin_verify_header(const VerifyRunOptions& options, const VerifyPlan& plan);

// "1600 × 1200, focal length 1400.0 px, lens 0123456789abcdef".
std::string describe_camera(const CameraDescription& camera);
// "85.60 × 53.98 × 0.80 mm, print 0123456789abcdef". Throws InputError where the print cannot be read.
std::string describe_card(const CardDescription& card);

// The station's devices, lens, card and that dish, and the digest of its file.
void add_station_conditions(const StationFile& station, const DishDescription& dish, VerifyHeader& header);

}  // namespace traygauge
