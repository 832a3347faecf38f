// One picture that shows a measurement: both views, the disparity, the heights.
#pragma once

#include <filesystem>

#include "firmware/measure/capture_session.hpp"
#include "firmware/measure/measure_report.hpp"

namespace traygauge {

// Draws what was reached, and says why where it was not. Throws OutputError.
void write_picture_sheet(const std::filesystem::path& file, const MeasureReport& report,
                         const CaptureSession& session);

}  // namespace traygauge
