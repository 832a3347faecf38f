// The [lens] table of a station's file.
#pragma once

#include <filesystem>

#include "drivers/v4l2/v4l2_camera.hpp"
#include "firmware/config/station_file.hpp"

namespace traygauge {

class JsonNode;

// `camera_table` and `camera`: of the camera that has the lens. A calibration file lies beside the station's,
// in `folder`. Throws InputError.
LensConfig read_lens_table(const JsonNode& table, const JsonNode& camera_table,
                           const V4l2CameraParams& camera, const std::filesystem::path& folder);

}  // namespace traygauge
