// A camera's lens as captures, stations and calibration files describe it.
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "simulator/capture/input_error.hpp"
#include "simulator/capture/picture.hpp"

namespace traygauge {

class JsonNode;
struct NumberRange;

// OpenCV's camera model: pinhole and k1, k2, p1, p2, k3. What few lenses need: k4, k5, k6 (radial
// denominator), s1 to s4 (thin prism), tau_x and tau_y (sensor tilt, radians); all 0 in most.
struct CameraDescription {
  PictureSize size;
  double fx_px = 0.0;
  double fy_px = 0.0;
  double cx_px = 0.0;
  double cy_px = 0.0;
  std::array<double, 5> distortion{};
  std::array<double, 9> further_distortion{};

  bool has_further_distortion() const;
  // As few of them as say all: 5, 8, 12 or 14.
  std::vector<double> coefficients() const;
};

inline constexpr const char* kDistortionCounts = "4, 5, 8, 12 or 14 coefficients of OpenCV's model";

// fx, fy, cx and cy, these in pixels from such ranges, and distortion. Throws InputError.
void read_camera_values(const JsonNode& node, NumberRange cx_range, NumberRange cy_range,
                        CameraDescription& camera);
// Of 4, 5, 8, 12 or 14 numbers, in OpenCV's order: a list, a list of lists, or a matrix as cv::FileStorage
// writes it. Throws InputError.
void read_distortion(const JsonNode& node, CameraDescription& camera);
// False for another count.
bool set_distortion(std::span<const double> coefficients, CameraDescription& camera);

// `place`: where the values stand. Throws InputError where focal lengths fit no camera, or where cx and cy
// are exchanged or outside the picture.
void check_camera(const InputFile& place, const CameraDescription& camera);
// Values of a picture size that is a simple multiple or part of the camera's, as the principal point shows,
// are scaled; `note` then says so. Before check_camera.
void mend_camera_scale(const InputFile& place, CameraDescription& camera, std::string& note);

// The same lens for pictures of another size that show the same.
CameraDescription scaled(const CameraDescription& camera, PictureSize size);
// Sizes that a scaled picture may have: sides in proportion, to a fifth of a per cent.
bool has_same_aspect(PictureSize a, PictureSize b);

}  // namespace traygauge
