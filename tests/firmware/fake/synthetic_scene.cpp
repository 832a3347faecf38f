#include "tests/firmware/fake/synthetic_scene.hpp"

#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <opencv2/core.hpp>

#include "core/labels/label_regions.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"

namespace traygauge {
namespace {

constexpr double kTiltRad = 0.35;
constexpr int kGridPx = 8;
constexpr double kBaselineFocal = 9000.0;  // disparity in px = this / depth in mm

}  // namespace

SyntheticScene::SyntheticScene(int width, int height)
    : width_(width),
      height_(height),
      camera_{kFocalPx, kFocalPx, 0.5 * (width - 1), 0.5 * (height - 1)},
      bottom_{{0.0, -std::sin(kTiltRad), -std::cos(kTiltRad)}, -kCameraHeightMm} {
  const cv::Mat labels = draw_labels(width, height);
  labels_.assign(labels.begin<std::uint8_t>(), labels.end<std::uint8_t>());
  depth_mm_.assign(labels_.size(), std::numeric_limits<float>::quiet_NaN());
  disparity_.assign(labels_.size(), kNoDisparity);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto i = static_cast<std::size_t>(y * width + x);
      if (!is_on_dish(labels_[i])) continue;
      const double z = point(x, y).z();
      depth_mm_[i] = static_cast<float>(z);
      disparity_[i] = static_cast<Disparity>(std::lround(kDisparityScale * kBaselineFocal / z));
    }
  }
  build_mesh();
  items_ = {{2, 1, StatusCode::ok, 101.25, 101.25, 0.0, 3500.0, 29.0, 31.5},
            {3, 1, StatusCode::ok, 22.5, 22.5, 0.0, 1900.0, 11.8, 12.5}};
}

double SyntheticScene::height_mm(int x, int y) const {
  const std::uint8_t label = labels_[static_cast<std::size_t>(y * width_ + x)];
  return label == 2 ? kHeight2Mm : label == 3 ? kHeight3Mm : 0.0;
}

Vec3 SyntheticScene::point(int x, int y) const {
  const Vec2 ray = camera_.ray({static_cast<double>(x), static_cast<double>(y)});
  const Vec3 direction(ray.x(), ray.y(), 1.0);
  return direction * ((bottom_.offset + height_mm(x, y)) / bottom_.normal.dot(direction));
}

void SyntheticScene::build_mesh() {
  std::map<std::pair<int, int>, std::int32_t> index;
  const auto label_at = [&](int x, int y) { return labels_[static_cast<std::size_t>(y * width_ + x)]; };
  for (int y = 0; y < height_; y += kGridPx) {
    for (int x = 0; x < width_; x += kGridPx) {
      if (!is_item(label_at(x, y))) continue;
      index[{x, y}] = static_cast<std::int32_t>(points_.size());
      points_.push_back({point(x, y), label_at(x, y)});
    }
  }
  for (const auto& [corner, first] : index) {
    const auto [x, y] = corner;
    const auto right = index.find({x + kGridPx, y});
    const auto below = index.find({x, y + kGridPx});
    if (right == index.end() || below == index.end()) continue;
    triangles_.push_back({{first, right->second, below->second}, label_at(x, y)});
  }
}

Measurement SyntheticScene::measurement() const {
  Measurement measurement;
  measurement.status = StatusCode::ok;
  measurement.items = items_;
  measurement.has_pose = true;
  measurement.second_from_first.translation = {120.0, 3.0, 25.0};
  measurement.relative_angle_deg = 17.5;
  measurement.stage_ms.fill(10.0);
  measurement.total_ms = 91.0;
  measurement.views.dish_bottom = bottom_;
  return measurement;
}

paper::WorkingPictures SyntheticScene::pictures() const {
  paper::WorkingPictures pictures;
  pictures.cameras = {camera_, camera_};
  pictures.labels[0] = {labels_.data(), width_, height_};
  pictures.disparity = {disparity_.data(), width_, height_};
  pictures.depth_mm = {depth_mm_.data(), width_, height_};
  pictures.mesh.points = points_;
  pictures.mesh.triangles = triangles_;
  return pictures;
}

}  // namespace traygauge
