// Surface grids from true depth, and the dishes that they show.
#pragma once

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "core/dish/dish_profile.hpp"
#include "core/stereo/surface_grid.hpp"
#include "tests/support/capture_truth.hpp"

namespace traygauge::test {

struct TrueGrid {
  int width = 0;
  int height = 0;
  std::vector<SurfacePoint> points;
  std::vector<SurfaceEvidence> evidence;
  std::vector<std::uint8_t> labels;
  Vec3 camera_mm = Vec3::Zero();

  TrueGrid() = default;
  TrueGrid(int width_, int height_)
      : width(width_),
        height(height_),
        points(count()),
        evidence(count(), SurfaceEvidence::none),
        labels(count(), 0) {}

  std::size_t count() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
  SurfaceGrid view() const {
    return {{points.data(), width, height},
            {evidence.data(), width, height},
            {labels.data(), width, height},
            camera_mm};
  }
};

struct DishItem {
  int label = 0;
  std::string name;
  double volume_ml = 0.0;
  double column_ml = 0.0;  // differs from the volume for items that overhang
  double footprint_mm2 = 0.0;
  bool is_scan = false;
  bool is_liquid = false;
};

struct DishInCapture {
  std::string name;
  InnerSurface dish;
  std::set<int> labels;  // the dish and what lies on it
  std::vector<DishItem> items;
};

inline DishModel dish_model_from_json(const nlohmann::json& entry) {
  DishModel model;
  model.outer_size_mm = {entry["outer_size_mm"][0], entry["outer_size_mm"][1]};
  model.rim_height_mm = entry["rim_height_mm"];
  model.bottom_height_mm = entry["bottom_height_mm"];
  for (const auto& point : entry["profile"]) {
    model.profile_points[model.profile_size++] = {point[0], point[1]};
  }
  return model;
}

// In single-dish captures the world's origin lies under the dish's centre; trays say where their dishes are.
inline std::vector<DishInCapture> dishes_of(const CaptureTruth& capture, const std::string& name) {
  std::vector<DishInCapture> dishes;
  const bool tray = capture.description.contains("dishes");
  const std::size_t count = tray ? capture.description["dishes"].size() : 1;
  for (std::size_t i = 0; i < count; ++i) {
    const nlohmann::json& entry = tray ? capture.description["dishes"][i] : capture.description["dish"];
    DishInCapture dish;
    const int dish_label = tray ? entry["label"].get<int>() : 1;
    dish.name = name;
    if (tray) dish.name.append(" ").append(std::to_string(dish_label));
    if (!dish.dish.profile.set(dish_model_from_json(entry)).ok()) continue;
    if (tray) {
      const nlohmann::json& truth = capture.truth["dishes"][i];
      const double turn = truth["rotation_deg"].get<double>() * M_PI / 180.0;
      dish.dish.place.centre_mm = vec3_from_json(truth["centre_mm"]).head<2>();
      dish.dish.place.axis = Vec2(std::cos(turn), std::sin(turn));
    }
    dish.labels.insert(dish_label);
    for (const auto& item : capture.truth["items"]) {
      if (tray && item["dish_label"].get<int>() != dish_label) continue;
      dish.labels.insert(item["label"].get<int>());
      dish.items.push_back({item["label"], item["name"], item["volume_ml"],
                            item.value("column_volume_ml", item["volume_ml"].get<double>()),
                            item["footprint_cm2"].get<double>() * 100.0, item["kind"] == "scan",
                            item.value("filled", false)});
    }
    dishes.push_back(std::move(dish));
  }
  return dishes;
}

// What view 0 truly sees of one dish: the stored pixels nearest to a grid on which the dish has so many
// samples.
inline TrueGrid true_grid(const CaptureTruth& capture, const DishInCapture& dish,
                          double dish_px = kWorkingDishPixels) {
  const TrueView& view = capture.views[0];
  const cv::Mat1b labels = view.read_labels();
  const cv::Mat1f depth = capture.read_depth_mm();
  int left = labels.cols, right = 0, top = labels.rows, bottom = 0, area = 0;
  for (int y = 0; y < labels.rows; ++y) {
    for (int x = 0; x < labels.cols; ++x) {
      if (!dish.labels.contains(labels(y, x))) continue;
      left = std::min(left, x);
      right = std::max(right, x);
      top = std::min(top, y);
      bottom = std::max(bottom, y);
      ++area;
    }
  }
  const double step = std::max(1.0, std::sqrt(area / dish_px));
  TrueGrid grid(static_cast<int>((right - left) / step) + 1, static_cast<int>((bottom - top) / step) + 1);
  grid.camera_mm = view.camera_from_world.inverse().translation;
  std::vector<cv::Point2d> pixels;
  for (int j = 0; j < grid.height; ++j) {
    for (int i = 0; i < grid.width; ++i) {
      pixels.emplace_back(std::lround(left + i * step), std::lround(top + j * step));
    }
  }
  const std::vector<cv::Point2d> rays = view.rays(pixels);
  const Pose world_from_camera = view.camera_from_world.inverse();
  for (std::size_t k = 0; k < pixels.size(); ++k) {
    const cv::Point pixel(static_cast<int>(pixels[k].x), static_cast<int>(pixels[k].y));
    if (!dish.labels.contains(labels(pixel)) || !(depth(pixel) > 0.0F)) continue;
    const Vec3 at = world_from_camera * (Vec3(rays[k].x, rays[k].y, 1.0) * static_cast<double>(depth(pixel)));
    grid.points[k] = {static_cast<float>(at.x()), static_cast<float>(at.y()), static_cast<float>(at.z())};
    grid.labels[k] = labels(pixel);
    grid.evidence[k] = SurfaceEvidence::both;
  }
  return grid;
}

}  // namespace traygauge::test
