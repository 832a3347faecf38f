#include "simulator/capture/camera_description.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "simulator/capture/json_node.hpp"

namespace traygauge {
namespace {

constexpr double kMaxFocalPx = 1e6;
constexpr NumberRange kDistortion{-1e3, 1e3};
constexpr std::size_t kMaxCoefficients = 14;
constexpr const char* kCountHint =
    "give k1, k2, p1, p2, k3, then k4, k5, k6, s1 to s4, tau_x, tau_y where used";

// Of the picture's longer side: what sees 136 degrees, and 3 degrees.
constexpr double kShortestFocal = 0.2;
constexpr double kLongestFocal = 20.0;
constexpr double kMaxPixelStretch = 1.5;  // between fx and fy

// A principal point lies within a few per cent of the middle; off by more than this share of half a side, it
// is looked at more closely.
constexpr double kMiddleTolerance = 0.2;
constexpr double kScaleTolerance = 0.04;
constexpr double kExchangeTolerance = 0.1;
constexpr std::array<double, 10> kUsualScales = {0.25,      1.0 / 3.0, 0.5, 2.0 / 3.0, 0.75,
                                                 4.0 / 3.0, 1.5,       2.0, 3.0,       4.0};

std::string number_text(double number) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", number);
  return text.data();
}

// Of a coordinate, over that of the middle.
double over_middle(double coordinate_px, int side_px) {
  return (coordinate_px + 0.5) / (0.5 * side_px);
}

bool is_near(double ratio, double wanted, double tolerance) {
  return std::abs(ratio / wanted - 1.0) <= tolerance;
}

bool is_near_middle(const CameraDescription& camera) {
  return is_near(over_middle(camera.cx_px, camera.size.width), 1.0, kMiddleTolerance) &&
         is_near(over_middle(camera.cy_px, camera.size.height), 1.0, kMiddleTolerance);
}

std::string key_below(const InputFile& place, const char* name) {
  return place.key.empty() ? name : place.key + "." + name;
}

void check_focal_length(const InputFile& place, const char* key, double focal_px, PictureSize size) {
  const double side = std::max(size.width, size.height);
  if (focal_px >= kShortestFocal * side && focal_px <= kLongestFocal * side) return;
  throw InputError({place.path, key_below(place, key)},
                   "a focal length in pixels, " + number_text(kShortestFocal * side) + " to " +
                       number_text(kLongestFocal * side) + " in pictures of " + size_text(size),
                   number_text(focal_px),
                   "correct it, or remove it and calibrate with pictures of this size");
}

}  // namespace

bool CameraDescription::has_further_distortion() const {
  return std::any_of(further_distortion.begin(), further_distortion.end(), [](double c) { return c != 0.0; });
}

std::vector<double> CameraDescription::coefficients() const {
  std::vector<double> all(distortion.begin(), distortion.end());
  all.insert(all.end(), further_distortion.begin(), further_distortion.end());
  std::size_t used = all.size();
  while (used > distortion.size() && all[used - 1] == 0.0) --used;
  for (const std::size_t count : {5U, 8U, 12U, 14U}) {
    if (used > count) continue;
    all.resize(count);
    break;
  }
  return all;
}

void read_camera_values(const JsonNode& node, NumberRange cx_range, NumberRange cy_range,
                        CameraDescription& camera) {
  camera.fx_px = node.member("fx").positive_number(kMaxFocalPx);
  camera.fy_px = node.member("fy").positive_number(kMaxFocalPx);
  camera.cx_px = node.member("cx").number(cx_range);
  camera.cy_px = node.member("cy").number(cy_range);
  read_distortion(node.member("distortion"), camera);
}

void read_distortion(const JsonNode& node, CameraDescription& camera) {
  const JsonNode list = node.is_object() ? node.member("data") : node;
  if (!list.is_list()) list.fail(kDistortionCounts, kCountHint);
  std::vector<double> numbers;
  if (!list.is_empty()) numbers = list.nested_numbers(1, kMaxCoefficients, kDistortion);
  if (!set_distortion(numbers, camera)) list.fail(kDistortionCounts, kCountHint);
}

bool set_distortion(std::span<const double> coefficients, CameraDescription& camera) {
  constexpr std::array<std::size_t, 5> counts = {4, 5, 8, 12, 14};
  if (std::find(counts.begin(), counts.end(), coefficients.size()) == counts.end()) return false;
  camera.distortion = {};
  camera.further_distortion = {};
  const std::size_t first = std::min(coefficients.size(), camera.distortion.size());
  std::copy_n(coefficients.begin(), first, camera.distortion.begin());
  std::copy(coefficients.begin() + static_cast<std::ptrdiff_t>(first), coefficients.end(),
            camera.further_distortion.begin());
  return true;
}

void check_camera(const InputFile& place, const CameraDescription& camera) {
  const PictureSize size = camera.size;
  const std::string found = "cx " + number_text(camera.cx_px) + " and cy " + number_text(camera.cy_px);
  const bool is_exchanged = !is_near_middle(camera) &&
                            is_near(over_middle(camera.cy_px, size.width), 1.0, kExchangeTolerance) &&
                            is_near(over_middle(camera.cx_px, size.height), 1.0, kExchangeTolerance);
  if (is_exchanged) {
    throw InputError({place.path, key_below(place, "cx")},
                     "a principal point near " + number_text(0.5 * size.width) + ", " +
                         number_text(0.5 * size.height) + " in pictures of " + size_text(size),
                     found, "exchange the two");
  }
  const auto check_centre = [&](const char* key, double centre_px, int side_px) {
    if (centre_px >= 0.0 && centre_px <= side_px - 1.0) return;
    throw InputError(
        {place.path, key_below(place, key)},
        "a number from 0 to " + std::to_string(side_px - 1) + ", within pictures of " + size_text(size),
        number_text(centre_px), "give width and height of the pictures that were calibrated with");
  };
  check_centre("cx", camera.cx_px, size.width);
  check_centre("cy", camera.cy_px, size.height);
  check_focal_length(place, "fx", camera.fx_px, size);
  check_focal_length(place, "fy", camera.fy_px, size);
  const double stretch = camera.fx_px / camera.fy_px;
  if (std::max(stretch, 1.0 / stretch) <= kMaxPixelStretch) return;
  throw InputError({place.path, key_below(place, "fy")}, "about fx, " + number_text(camera.fx_px),
                   number_text(camera.fy_px), "correct one of the two");
}

void mend_camera_scale(const InputFile& place, CameraDescription& camera, std::string& note) {
  if (is_near_middle(camera)) return;
  const double x = over_middle(camera.cx_px, camera.size.width);
  const double y = over_middle(camera.cy_px, camera.size.height);
  for (const double scale : kUsualScales) {
    if (!is_near(x, scale, kScaleTolerance) || !is_near(y, scale, kScaleTolerance)) continue;
    const PictureSize size = camera.size;
    CameraDescription given = camera;
    given.size = {static_cast<int>(std::lround(scale * size.width)),
                  static_cast<int>(std::lround(scale * size.height))};
    note = printable(place.path.string()) + ": " + (place.key.empty() ? "" : place.key + ": ") +
           "fx, fy, cx and cy are those of pictures of " + size_text(given.size) + ", not of " +
           size_text(size) + " (cx " + number_text(camera.cx_px) + ", cy " + number_text(camera.cy_px) +
           "), and are scaled; give the values for " + size_text(size) + ".";
    camera = scaled(given, size);
    return;
  }
}

CameraDescription scaled(const CameraDescription& camera, PictureSize size) {
  const double by_x = static_cast<double>(size.width) / camera.size.width;
  const double by_y = static_cast<double>(size.height) / camera.size.height;
  CameraDescription result = camera;
  result.size = size;
  result.fx_px *= by_x;
  result.fy_px *= by_y;
  result.cx_px = (camera.cx_px + 0.5) * by_x - 0.5;
  result.cy_px = (camera.cy_px + 0.5) * by_y - 0.5;
  return result;
}

bool has_same_aspect(PictureSize a, PictureSize b) {
  constexpr double tolerance = 0.002;
  const double ratio = (static_cast<double>(a.width) * b.height) / (static_cast<double>(b.width) * a.height);
  return std::abs(ratio - 1.0) <= tolerance;
}

}  // namespace traygauge
