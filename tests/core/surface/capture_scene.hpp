// A rendered capture with its truth, as working pictures: undistorted, the dish resized to 2^17 pixels.
#pragma once

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "core/base/geometry.hpp"
#include "core/image/camera.hpp"
#include "core/image_view/image_view.hpp"

namespace traygauge::testing {

struct TrueItem {
  int label = 0;
  std::string name;
  double volume_ml = 0.0;
  double above_bottom_ml = 0.0;  // down to the plane of the flat bottom; 0 where not given
  double max_height_mm = 0.0;
};

struct WorkingView {
  PinholeCamera camera;
  cv::Mat1b labels;
  Pose camera_from_world;  // mm; world z = 0 is the table
};

struct CaptureScene {
  std::string name;
  std::vector<WorkingView> views;
  cv::Mat1f depth_mm;  // of view 0
  std::vector<std::pair<int, int>> pairs;
  std::vector<TrueItem> items;
  std::vector<Vec3> card_corners_mm;  // in the world
  std::array<double, 2> outer_size_mm{};
  double rim_height_mm = 0.0;
  double bottom_height_mm = 0.0;
  double card_thickness_mm = 0.0;
};

inline std::filesystem::path captures_folder() {
  const char* folder = std::getenv("TRAYGAUGE_CAPTURES");
  return folder == nullptr ? std::filesystem::path() : std::filesystem::path(folder);
}

// Captures with a single dish.
inline std::vector<std::string> single_dish_captures() {
  return {"angles/a01", "meals/m01",        "meals/m04",      "meals/m06",     "meals/m08",
          "meals/m11",  "plates/c1_dinner", "plates/c1_oval", "plates/c1_soup"};
}

template <class T>
ImageView<const T> view_of(const cv::Mat_<T>& mat) {
  return {mat.template ptr<T>(), mat.cols, mat.rows, static_cast<std::ptrdiff_t>(mat.step1())};
}
template <class T>
ImageView<T> mutable_view_of(cv::Mat_<T>& mat) {
  return {mat.template ptr<T>(), mat.cols, mat.rows, static_cast<std::ptrdiff_t>(mat.step1())};
}

inline nlohmann::json read_json(const std::filesystem::path& path) {
  std::ifstream file(path);
  return nlohmann::json::parse(file);
}

// Height over the table of a plane given in a camera: `plane` in the world.
inline Plane plane_in_camera(const Plane& world, const Pose& camera_from_world) {
  const Vec3 normal = camera_from_world.rotation * world.normal;
  return {normal, world.offset + normal.dot(camera_from_world.translation)};
}

class LensRemap {
 public:
  LensRemap(const nlohmann::json& camera, double scale) {
    const cv::Matx33d matrix(camera["fx"], 0, camera["cx"], 0, camera["fy"], camera["cy"], 0, 0, 1);
    std::vector<double> distortion = camera["distortion"];
    const cv::Size size(static_cast<int>(std::lround(camera["width"].get<double>() * scale)),
                        static_cast<int>(std::lround(camera["height"].get<double>() * scale)));
    pinhole = {scale * camera["fx"].get<double>(), scale * camera["fy"].get<double>(),
               scale * (camera["cx"].get<double>() + 0.5) - 0.5,
               scale * (camera["cy"].get<double>() + 0.5) - 0.5};
    const cv::Matx33d target(pinhole.fx_px, 0, pinhole.cx_px, 0, pinhole.fy_px, pinhole.cy_px, 0, 0, 1);
    cv::initUndistortRectifyMap(matrix, distortion, cv::noArray(), target, size, CV_32FC1, map_x_, map_y_);
  }
  cv::Mat apply(const cv::Mat& source, int interpolation) const {
    cv::Mat target;
    cv::remap(source, target, map_x_, map_y_, interpolation, cv::BORDER_CONSTANT, 0);
    return target;
  }
  PinholeCamera pinhole;

 private:
  cv::Mat map_x_;
  cv::Mat map_y_;
};

inline double scale_to_dish_area(const cv::Mat1b& labels, double dish_px) {
  const cv::Mat on_dish = (labels > 0) & (labels < 200);
  return std::sqrt(dish_px / cv::countNonZero(on_dish));
}

// Depth between pixels where the surface is continuous, else the nearest.
inline cv::Mat1f remap_depth(const LensRemap& remap, const cv::Mat& stored) {
  cv::Mat1f depth;
  stored.convertTo(depth, CV_32F, 0.02);
  const cv::Mat1f smooth = remap.apply(depth, cv::INTER_LINEAR);
  cv::Mat1f result = remap.apply(depth, cv::INTER_NEAREST);
  for (int y = 0; y < result.rows; ++y) {
    for (int x = 0; x < result.cols; ++x) {
      if (std::abs(smooth(y, x) - result(y, x)) < 1.0F) result(y, x) = smooth(y, x);
      if (!(result(y, x) > 0.0F)) result(y, x) = std::numeric_limits<float>::quiet_NaN();
    }
  }
  return result;
}

inline void read_truth(const nlohmann::json& capture, const nlohmann::json& truth, CaptureScene& scene) {
  for (const auto& item : truth["items"]) {
    scene.items.push_back({item["label"], item["name"], item["volume_ml"],
                           item.value("volume_above_bottom_plane_ml", 0.0),
                           item.value("max_height_mm", 0.0)});
  }
  for (const auto& corner : truth["card_corners_mm"]) {
    scene.card_corners_mm.emplace_back(corner[0], corner[1], corner[2]);
  }
  scene.outer_size_mm = {capture["dish"]["outer_size_mm"][0], capture["dish"]["outer_size_mm"][1]};
  scene.rim_height_mm = capture["dish"]["rim_height_mm"];
  scene.bottom_height_mm = capture["dish"]["bottom_height_mm"];
  scene.card_thickness_mm = capture["card"]["thickness_mm"];
  for (const auto& pair : capture["pairs"]) scene.pairs.emplace_back(pair[0], pair[1]);
}

inline CaptureScene load_scene(const std::string& name, double dish_px = 131072.0) {
  const std::filesystem::path folder = captures_folder() / name;
  const nlohmann::json capture = read_json(folder / "capture.json");
  const nlohmann::json truth = read_json(folder / "truth.json");
  CaptureScene scene;
  scene.name = name;
  read_truth(capture, truth, scene);
  for (std::size_t i = 0; i < capture["views"].size(); ++i) {
    const std::string file = capture["views"][i]["labels"];
    const cv::Mat1b stored = cv::imread((folder / file).string(), cv::IMREAD_GRAYSCALE);
    const LensRemap remap(capture["camera"], scale_to_dish_area(stored, dish_px));
    WorkingView view;
    view.camera = remap.pinhole;
    view.labels = remap.apply(stored, cv::INTER_NEAREST);
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c)
        view.camera_from_world.rotation(r, c) =
            truth["poses"][i][static_cast<std::size_t>(r)][static_cast<std::size_t>(c)];
      view.camera_from_world.translation[r] = truth["poses"][i][static_cast<std::size_t>(r)][3];
    }
    if (i == 0) {
      scene.depth_mm =
          remap_depth(remap, cv::imread((folder / "depth_0.png").string(), cv::IMREAD_UNCHANGED));
    }
    scene.views.push_back(view);
  }
  return scene;
}

}  // namespace traygauge::testing
