#include "tests/core/rectification/capture_pair.hpp"

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace traygauge {
namespace {

constexpr int kBorder_px = 16;          // around the dish
constexpr double kDepthUnit_mm = 0.02;  // of depth_0.png
constexpr int kLastItem = 199;

nlohmann::json read_json(const std::string& path) {
  std::ifstream file(path);
  return nlohmann::json::parse(file);
}

Pose pose_from_json(const nlohmann::json& rows) {
  Pose pose;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j)
      pose.rotation(i, j) = rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    pose.translation[i] = rows[static_cast<std::size_t>(i)][3];
  }
  return pose;
}

cv::Mat undistort(const cv::Mat& stored, const cv::Mat& from, const cv::Mat& lens, const cv::Mat& to,
                  cv::Size size, int interpolation) {
  cv::Mat map_x, map_y, result;
  cv::initUndistortRectifyMap(from, lens, cv::Mat(), to, size, CV_32FC1, map_x, map_y);
  cv::remap(stored, result, map_x, map_y, interpolation);
  return result;
}

}  // namespace

WorkingView load_view(const std::string& capture, int view, double dish_pixels) {
  const auto json = read_json(capture + "/capture.json");
  const auto& camera = json["camera"];
  const auto& files = json["views"][static_cast<std::size_t>(view)];
  const cv::Mat stored =
      (cv::Mat_<double>(3, 3) << camera["fx"].get<double>(), 0.0, camera["cx"].get<double>(), 0.0,
       camera["fy"].get<double>(), camera["cy"].get<double>(), 0.0, 0.0, 1.0);
  const cv::Mat lens(camera["distortion"].get<std::vector<double>>(), true);
  const cv::Mat gray = cv::imread(capture + "/" + files["image"].get<std::string>(), cv::IMREAD_GRAYSCALE);
  const cv::Mat labels = cv::imread(capture + "/" + files["labels"].get<std::string>(), cv::IMREAD_UNCHANGED);
  const cv::Mat dish = undistort((labels >= 1) & (labels <= kLastItem), stored, lens, stored, labels.size(),
                                 cv::INTER_NEAREST);
  const double scale = std::sqrt(dish_pixels / cv::countNonZero(dish));
  const cv::Rect box = cv::boundingRect(dish);
  const cv::Point corner(static_cast<int>(scale * box.x) - kBorder_px,
                         static_cast<int>(scale * box.y) - kBorder_px);
  const cv::Size size(static_cast<int>(scale * box.width) + 2 * kBorder_px,
                      static_cast<int>(scale * box.height) + 2 * kBorder_px);
  cv::Mat working = scale * stored;
  working.at<double>(0, 2) += 0.5 * scale - 0.5 - corner.x;
  working.at<double>(1, 2) += 0.5 * scale - 0.5 - corner.y;
  working.at<double>(2, 2) = 1.0;

  WorkingView result;
  cv::Mat smooth;
  cv::GaussianBlur(gray, smooth, {}, 0.5 / scale);  // against aliasing
  result.gray = undistort(smooth, stored, lens, working, size, cv::INTER_CUBIC);
  result.region =
      undistort((labels >= 1) & (labels <= kLastItem), stored, lens, working, size, cv::INTER_NEAREST) / 255;
  if (view == 0) {
    cv::Mat depth;
    cv::imread(capture + "/depth_0.png", cv::IMREAD_UNCHANGED).convertTo(depth, CV_32F, kDepthUnit_mm);
    result.depth = undistort(depth, stored, lens, working, size, cv::INTER_LINEAR);
  }
  result.camera = {working.at<double>(0, 0), working.at<double>(1, 1), working.at<double>(0, 2),
                   working.at<double>(1, 2)};
  result.camera_from_world =
      pose_from_json(read_json(capture + "/truth.json")["poses"][static_cast<std::size_t>(view)]);
  return result;
}

std::vector<std::pair<int, int>> capture_pairs(const std::string& capture) {
  return read_json(capture + "/capture.json")["pairs"];
}

std::string captures_folder() {
  const char* folder = std::getenv("TRAYGAUGE_CAPTURES");
  return folder == nullptr ? "" : folder;
}

}  // namespace traygauge
