// Rendered captures and photographs with known cameras, for the tests of single stages. Lenses are undone by
// OpenCV, not by the code under test.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <utility>
#include <vector>

#include "core/geometry/camera.hpp"
#include "core/geometry/geometry.hpp"
#include "tests/support/opencv_camera.hpp"

namespace traygauge::test {

inline constexpr double kWorkingDishPixels = 131072.0;  // 2^17: what the dish measures in a working picture

// The folder that TRAYGAUGE_CAPTURES names; empty when it does not.
std::filesystem::path captures_folder();

nlohmann::json read_json(const std::filesystem::path& file);
Vec3 vec3_from_json(const nlohmann::json& values);
// From three or four rows of four numbers.
Pose pose_from_json(const nlohmann::json& rows);

struct TrueView {
  std::filesystem::path image;
  std::filesystem::path labels;  // empty without labels
  LensModel lens;
  Pose camera_from_world;  // mm; the table is z = 0

  cv::Mat1b read_gray() const;
  cv::Mat1b read_labels() const;
  // Rays (z = 1) of pixels of the stored picture.
  std::vector<cv::Point2d> rays(const std::vector<cv::Point2d>& pixels) const;
};

struct CaptureTruth {
  std::filesystem::path folder;
  nlohmann::json description;  // capture.json
  nlohmann::json truth;        // truth.json
  std::vector<TrueView> views;
  std::vector<std::pair<int, int>> pairs;
  std::vector<Vec3> card_corners_mm;  // of the print, in the world, clockwise from the pattern's origin

  cv::Mat1f read_depth_mm() const;  // of view 0 as stored; 0 where unknown
};

CaptureTruth read_capture_truth(const std::filesystem::path& folder);

// The views of cameras.json, in a folder of `real`.
std::vector<TrueView> read_real_views(const std::filesystem::path& folder);

Pose motion_between(const Pose& first_from_world, const Pose& second_from_world);
// A plane of the world, in a camera.
Plane plane_in_camera(const Plane& world, const Pose& camera_from_world);

// The camera of a picture resized by `scale`; pixel centres lie at integers.
PinholeCamera enlarge(const PinholeCamera& camera, double scale);

// 255 on the first dish and its food, labels 1 … 199.
cv::Mat1b dish_mask(const cv::Mat1b& labels);

// Maps stored pictures to those of a pinhole camera.
class Undistortion {
 public:
  Undistortion(const LensModel& lens, const PinholeCamera& target, cv::Size size);
  cv::Mat apply(const cv::Mat& stored, int interpolation) const;

 private:
  cv::Mat map_x_;
  cv::Mat map_y_;
};

}  // namespace traygauge::test
