// Profile paper on points that others found.
#pragma once

#include <cstdint>

#include "firmware/measure/capture_session.hpp"
#include "tests/evaluation/methods/pair_features.hpp"

namespace traygauge::tables {

// Valid until the session's next measurement. Its times leave out `matches.time_ms`.
const Measurement& measure_given(CaptureSession& session, const PairMatches& matches, std::uint64_t seed);

}  // namespace traygauge::tables
