#include "tests/support/photograph_scene.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "tests/core/paper/photographs.hpp"
#include "tests/core/stereo/capture_scene.hpp"

namespace traygauge::test {
namespace {

constexpr int kFeatures = 5000;
constexpr std::size_t kMinSightings = 4;

struct Sighting {
  std::size_t photograph = 0;
  Vec2 ray = Vec2::Zero();
};

// The point nearest to all lines of sight.
Vec3 nearest_point(const std::vector<Photograph>& photographs, const std::vector<Sighting>& sightings) {
  Mat3 normal = Mat3::Zero();
  Vec3 right = Vec3::Zero();
  for (const Sighting& sighting : sightings) {
    const Pose table_from_camera = photographs[sighting.photograph].view.camera_from_world.inverse();
    const Vec3 direction = (table_from_camera.rotation * sighting.ray.homogeneous()).normalized();
    const Mat3 across = Mat3::Identity() - direction * direction.transpose();
    normal += across;
    right += across * table_from_camera.translation;
  }
  return normal.inverse() * right;
}

bool is_seen_there(const Photograph& photograph, const Vec2& ray, const Vec3& point_mm, double max_px) {
  const Vec3 seen = photograph.view.camera_from_world * point_mm;
  return seen.z() > 0.0 &&
         photograph.view.lens.pinhole.mean_focal_px() * (seen.hnormalized() - ray).norm() <= max_px;
}

double percentile(std::vector<double>& values, double share) {
  if (values.empty()) return 0.0;
  const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

class Deviations {
 public:
  Deviations(const Photograph& seen, const Photograph& other)
      : other_(other),
        other_from_seen_(motion_between(seen.view.camera_from_world, other.view.camera_from_world)) {}
  void add(const Vec2& ray, double depth_mm, double reference_mm) {
    const auto pixel = [&](double z) {
      const Vec3 there = other_from_seen_ * Vec3(ray.x() * z, ray.y() * z, z);
      return Vec2(other_.view.lens.pinhole.mean_focal_px() * there.hnormalized());
    };
    px_.push_back((pixel(depth_mm) - pixel(reference_mm)).norm());
    signed_mm_.push_back(depth_mm - reference_mm);
    mm_.push_back(std::abs(depth_mm - reference_mm));
  }
  void miss() { ++missing_; }
  SurfaceDeviation summary() {
    return {static_cast<int>(px_.size()), missing_,
            percentile(px_, 0.5),         percentile(px_, 0.9),
            percentile(mm_, 0.5),         percentile(signed_mm_, 0.5)};
  }

 private:
  const Photograph& other_;
  Pose other_from_seen_;
  int missing_ = 0;
  std::vector<double> px_;
  std::vector<double> mm_;
  std::vector<double> signed_mm_;
};

}  // namespace

StoredView Photograph::stored() const {
  const cv::Rect box = cv::boundingRect(dish_mask(labels));
  return {view_of(gray),
          view_of(labels),
          {box.x, box.y, box.x + box.width, box.y + box.height},
          view.lens,
          view.camera_from_world};
}

Vec2 Photograph::pixel_of(const Vec3& point_mm) const {
  return view.lens.pixel((view.camera_from_world * point_mm).hnormalized());
}

Photograph read_photograph(const TrueView& view, double mm_per_unit, const Pose& table_from_world) {
  Photograph photograph;
  photograph.view = view;
  photograph.view.camera_from_world.translation *= mm_per_unit;
  photograph.view.camera_from_world = photograph.view.camera_from_world * table_from_world.inverse();
  photograph.gray = view.read_gray();
  photograph.view.lens.width = photograph.gray.cols;
  photograph.view.lens.height = photograph.gray.rows;
  return photograph;
}

std::vector<ScenePoint> triangulate_features(const std::vector<Photograph>& photographs,
                                             std::size_t reference, double max_residual_px) {
  const Features own = detect(photographs[reference].view, kFeatures);
  std::map<std::pair<double, double>, std::vector<Sighting>> sightings;
  for (std::size_t i = 0; i < photographs.size(); ++i) {
    if (i == reference) continue;
    for (const RayMatch& found : match(own, detect(photographs[i].view, kFeatures))) {
      sightings[{found.first.x(), found.first.y()}].push_back({i, found.second});
    }
  }
  std::vector<ScenePoint> points;
  for (auto& [ray, seen] : sightings) {
    seen.push_back({reference, {ray.first, ray.second}});
    if (seen.size() < kMinSightings) continue;
    const Vec3 point_mm = nearest_point(photographs, seen);
    const bool agrees = std::all_of(seen.begin(), seen.end(), [&](const Sighting& sighting) {
      return is_seen_there(photographs[sighting.photograph], sighting.ray, point_mm, max_residual_px);
    });
    if (agrees) points.push_back({{ray.first, ray.second}, point_mm});
  }
  return points;
}

cv::Mat1f depth_map(const SurfaceGrid& grid, const Photograph& seen, int reach_px) {
  cv::Mat1f depth_mm(seen.gray.size(), 0.0F);
  cv::Mat1f distance_px(seen.gray.size(), static_cast<float>(reach_px) + 0.5F);
  const auto offer = [&](const Vec2& pixel, float depth, const cv::Point& at) {
    const auto distance = static_cast<float>((pixel - Vec2(at.x, at.y)).norm());
    if (!cv::Rect({0, 0}, depth_mm.size()).contains(at) || distance >= distance_px(at)) return;
    distance_px(at) = distance;
    depth_mm(at) = depth;
  };
  for (int row = 0; row < grid.points.height; ++row) {
    for (int column = 0; column < grid.points.width; ++column) {
      const SurfaceEvidence evidence = grid.evidence.at(column, row);
      if (evidence == SurfaceEvidence::none || evidence == SurfaceEvidence::filled) continue;
      const SurfacePoint& point = grid.points.at(column, row);
      const Vec3 point_mm(point.x_mm, point.y_mm, point.z_mm);
      const Vec2 pixel = seen.pixel_of(point_mm);
      const auto depth = static_cast<float>((seen.view.camera_from_world * point_mm).z());
      const int x = static_cast<int>(std::lround(pixel.x()));
      const int y = static_cast<int>(std::lround(pixel.y()));
      for (int dy = -reach_px; dy <= reach_px; ++dy) {
        for (int dx = -reach_px; dx <= reach_px; ++dx) offer(pixel, depth, {x + dx, y + dy});
      }
    }
  }
  return depth_mm;
}

SurfaceDeviation compare_depth(const cv::Mat1f& depth_mm, const Photograph& seen, const Photograph& other,
                               const std::vector<ScenePoint>& points) {
  Deviations deviations(seen, other);
  for (const ScenePoint& point : points) {
    const Vec2 pixel = seen.pixel_of(point.point_mm);
    const cv::Point at(static_cast<int>(std::lround(pixel.x())), static_cast<int>(std::lround(pixel.y())));
    if (!cv::Rect({0, 0}, depth_mm.size()).contains(at) || seen.labels(at) == 0) continue;
    if (depth_mm(at) > 0.0F) {
      deviations.add(point.ray, depth_mm(at), (seen.view.camera_from_world * point.point_mm).z());
    } else {
      deviations.miss();
    }
  }
  return deviations.summary();
}

SurfaceDeviation compare_depth(const cv::Mat1f& depth_mm, const cv::Mat1f& reference_mm,
                               const Photograph& seen, const Photograph& other) {
  Deviations deviations(seen, other);
  for (int y = 0; y < depth_mm.rows; ++y) {
    for (int x = 0; x < depth_mm.cols; ++x) {
      if (!(depth_mm(y, x) > 0.0F)) continue;
      Vec2 ray;
      if (reference_mm(y, x) > 0.0F && seen.view.lens.undistort_pixel({x, y}, ray)) {
        deviations.add(ray, depth_mm(y, x), reference_mm(y, x));
      } else {
        deviations.miss();
      }
    }
  }
  return deviations.summary();
}

}  // namespace traygauge::test
