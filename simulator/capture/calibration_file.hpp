// A camera's calibration as OpenCV's programs store it.
#pragma once

#include <optional>

#include "simulator/capture/camera_description.hpp"
#include "simulator/capture/input_error.hpp"

namespace traygauge {

// YAML, XML or JSON of cv::FileStorage, or YAML of ROS: camera_matrix, distortion_coefficients, image_width
// and image_height, under one of their usual names. `size`: of the pictures calibrated with, where the file
// does not say it. Values are not checked. Throws InputError.
CameraDescription read_calibration_file(const InputFile& file, std::optional<PictureSize> size);

}  // namespace traygauge
