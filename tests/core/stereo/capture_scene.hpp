// A rendered capture with its truth, as working pictures: undistorted, the dish resized to 2^17 pixels.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "core/image_view/image_view.hpp"
#include "tests/support/capture_truth.hpp"
#include "tests/support/pictures.hpp"

namespace traygauge::test {

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

// Captures with a single dish.
inline std::vector<std::string> single_dish_captures() {
  return {"angles/a01", "meals/m01",        "meals/m04",      "meals/m06",     "meals/m08",
          "meals/m11",  "plates/c1_dinner", "plates/c1_oval", "plates/c1_soup"};
}

// Depth between pixels where the surface is continuous, else the nearest.
inline cv::Mat1f remap_depth(const Undistortion& remap, const cv::Mat1f& stored_mm) {
  const cv::Mat1f smooth = remap.apply(stored_mm, cv::INTER_LINEAR);
  cv::Mat1f result = remap.apply(stored_mm, cv::INTER_NEAREST);
  for (int y = 0; y < result.rows; ++y) {
    for (int x = 0; x < result.cols; ++x) {
      if (std::abs(smooth(y, x) - result(y, x)) < 1.0F) result(y, x) = smooth(y, x);
      if (!(result(y, x) > 0.0F)) result(y, x) = std::numeric_limits<float>::quiet_NaN();
    }
  }
  return result;
}

inline void read_items(const CaptureTruth& capture, CaptureScene& scene) {
  for (const auto& item : capture.truth["items"]) {
    scene.items.push_back({item["label"], item["name"], item["volume_ml"],
                           item.value("volume_above_bottom_plane_ml", 0.0),
                           item.value("max_height_mm", 0.0)});
  }
  const auto& dish = capture.description["dish"];
  scene.outer_size_mm = {dish["outer_size_mm"][0], dish["outer_size_mm"][1]};
  scene.rim_height_mm = dish["rim_height_mm"];
  scene.bottom_height_mm = dish["bottom_height_mm"];
  scene.card_thickness_mm = capture.description["card"]["thickness_mm"];
}

inline CaptureScene load_scene(const std::string& name, double dish_px = kWorkingDishPixels) {
  const CaptureTruth capture = read_capture_truth(captures_folder() / name);
  CaptureScene scene;
  scene.name = name;
  scene.pairs = capture.pairs;
  scene.card_corners_mm = capture.card_corners_mm;
  read_items(capture, scene);
  for (const TrueView& stored : capture.views) {
    const cv::Mat1b labels = stored.read_labels();
    const double scale = std::sqrt(dish_px / cv::countNonZero(dish_mask(labels)));
    WorkingView view;
    view.camera = enlarge(stored.lens.pinhole, scale);
    const cv::Size size(static_cast<int>(std::lround(stored.lens.width * scale)),
                        static_cast<int>(std::lround(stored.lens.height * scale)));
    const Undistortion remap(stored.lens, view.camera, size);
    view.labels = remap.apply(labels, cv::INTER_NEAREST);
    view.camera_from_world = stored.camera_from_world;
    if (scene.views.empty()) scene.depth_mm = remap_depth(remap, capture.read_depth_mm());
    scene.views.push_back(view);
  }
  return scene;
}

}  // namespace traygauge::test
