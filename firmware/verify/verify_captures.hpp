// An acceptance test on captures, one folder a step.
#pragma once

#include <atomic>
#include <filesystem>
#include <iosfwd>
#include <string>

#include "firmware/verify/verify_record.hpp"

namespace traygauge {

struct VerifyRunOptions;

// FOLDER/STEP, and for further attempts FOLDER/STEP.2, FOLDER/STEP.3, …: where there is none, a refused step
// stays refused. Appends to the record until all is done or `stop`. Throws InputError, UsageError,
// OutputError.
VerifyRecord run_verify_captures(const VerifyRunOptions& options, const VerifyPlan& plan,
                                 const std::atomic<bool>& stop, std::ostream& out);

}  // namespace traygauge
