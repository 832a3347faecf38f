#include "firmware/calibrate/standard_meal.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include "core/card/card_size.hpp"
#include "core/geometry/levenberg_marquardt.hpp"
#include "core/geometry/table_frame.hpp"
#include "core/geometry/triangulation.hpp"

namespace traygauge {
namespace {

constexpr int kCameraPair = 12;  // parameters: a step of the first camera, of the second
constexpr double kRadians = std::numbers::pi / 180.0;

enum class Known : std::uint8_t {
  nothing,  // food: seen in both views
  height,   // table
  place,    // card
};

struct MealPoint {
  Vec3 point_mm = Vec3::Zero();
  Known known = Known::nothing;
  double share_mm2 = 0.0;  // of the table that the point stands for; of food
  RayMatch rays;           // by the assumed lens
};

// Over the table's plane z = 0, looking at its origin.
Pose camera_above(double distance_mm, double tilt_rad) {
  Pose camera;
  const Vec3 centre(0.0, -distance_mm * std::sin(tilt_rad), distance_mm * std::cos(tilt_rad));
  const Vec3 forward = -centre.normalized();
  const Vec3 right = Vec3::UnitX();
  camera.rotation.row(0) = right;
  camera.rotation.row(1) = forward.cross(right);
  camera.rotation.row(2) = forward;
  camera.translation = -(camera.rotation * centre);
  return camera;
}

std::vector<MealPoint> lay_meal(const StandardMealParams& params) {
  std::vector<MealPoint> points;
  const CardModelSize card;
  const int reach = static_cast<int>(params.table_radius_mm / params.grid_mm);
  for (int row = -reach; row <= reach; ++row) {
    for (int column = -reach; column <= reach; ++column) {
      const Vec2 place(params.grid_mm * column, params.grid_mm * row);
      const double from_middle = place.norm() / params.radius_mm;
      MealPoint point;
      point.point_mm << place, 0.0;
      point.known = Known::height;
      if (from_middle < 1.0) {
        point.known = Known::nothing;
        point.point_mm.z() = params.height_mm * (1.0 - from_middle * from_middle);
        point.share_mm2 = params.grid_mm * params.grid_mm;
      }
      points.push_back(point);
    }
  }
  for (int row = -1; row <= 1; ++row) {
    for (int column = -2; column <= 2; ++column) {
      MealPoint point;
      point.known = Known::place;
      point.point_mm = {params.card_from_middle_mm + 0.5 * card.height_mm * row,
                        0.25 * card.width_mm * column, card.thickness_mm};
      points.push_back(point);
    }
  }
  return points;
}

bool look(const LensModel& actual, const LensModel& assumed, const Pose& camera, const Vec3& point_mm,
          Vec2& ray) {
  const Vec3 seen = camera * point_mm;
  if (!(seen.z() > 0.0)) return false;
  const Vec2 pixel = actual.pixel(seen.hnormalized());
  return assumed.undistort_pixel(pixel, ray);
}

// Pixels off, all of equal weight: epipolar lines for every match, the plane for the table, places for the
// card. Derivatives by differences: there are a few hundred points, and this is done a few times.
class CameraProblem {
 public:
  CameraProblem(std::span<const MealPoint> points, double focal_px) : points_(points), focal_px_(focal_px) {}

  double cost(const TableCameras& cameras) const {
    double sum = 0.0;
    for (const double residual : residuals(cameras)) sum += residual * residual;
    return sum;
  }
  double linearise(const TableCameras& cameras, NormalEquations<kCameraPair>& equations) const {
    using Vector = NormalEquations<kCameraPair>::Vector;
    const std::vector<double> at = residuals(cameras);
    std::vector<Vector> jacobian(at.size());
    for (int i = 0; i < kCameraPair; ++i) {
      const double step = i % 6 < 3 ? 1e-6 : 1e-3;  // radians, mm
      const std::vector<double> up = residuals(moved(cameras, step * Vector::Unit(i)));
      const std::vector<double> down = residuals(moved(cameras, -step * Vector::Unit(i)));
      for (std::size_t k = 0; k < at.size(); ++k) jacobian[k][i] = (up[k] - down[k]) / (2.0 * step);
    }
    double sum = 0.0;
    for (std::size_t k = 0; k < at.size(); ++k) {
      equations.add(at[k], jacobian[k]);
      sum += at[k] * at[k];
    }
    return sum;
  }
  static TableCameras moved(const TableCameras& cameras, const NormalEquations<kCameraPair>::Vector& step) {
    return {traygauge::moved(cameras[0], step.head<6>()), traygauge::moved(cameras[1], step.tail<6>())};
  }

 private:
  std::vector<double> residuals(const TableCameras& cameras) const {
    const Pose motion = second_from_first(cameras);
    const Mat3 essential = skew(motion.translation) * motion.rotation;
    std::vector<double> off_px;
    for (const MealPoint& point : points_) {
      if (point.known == Known::place) {
        for (std::size_t v = 0; v < 2; ++v) {
          const Vec2 off =
              (cameras[v] * point.point_mm).hnormalized() - (v == 0 ? point.rays.first : point.rays.second);
          off_px.insert(off_px.end(), {focal_px_ * off.x(), focal_px_ * off.y()});
        }
        continue;
      }
      const Vec3 line = essential * point.rays.first.homogeneous();
      off_px.push_back(focal_px_ * line.dot(point.rays.second.homogeneous()) / line.head<2>().norm());
      if (point.known == Known::nothing) continue;
      // Where the first ray meets the table, seen in the second view along the line.
      const Vec3 direction = cameras[0].rotation.transpose() * point.rays.first.homogeneous();
      const Vec3 centre = camera_centre_mm(cameras[0]);
      const Vec3 on_table = centre - direction * (centre.z() / direction.z());
      const Vec2 along = Vec2(line.y(), -line.x()).normalized();
      off_px.push_back(focal_px_ * along.dot((cameras[1] * on_table).hnormalized() - point.rays.second));
    }
    return off_px;
  }

  std::span<const MealPoint> points_;
  double focal_px_;
};

}  // namespace

std::optional<double> volume_deviation(const LensModel& actual, const LensModel& assumed,
                                       const StandardMealParams& params) {
  const double distance_mm = params.view_width_mm * actual.pinhole.fx_px / actual.width;
  TableCameras cameras = {
      camera_above(distance_mm, kRadians * params.first_tilt_deg),
      camera_above(distance_mm, kRadians * (params.first_tilt_deg + params.second_view_deg))};
  std::vector<MealPoint> points = lay_meal(params);
  double true_mm3 = 0.0;
  for (MealPoint& point : points) {
    if (!look(actual, assumed, cameras[0], point.point_mm, point.rays.first) ||
        !look(actual, assumed, cameras[1], point.point_mm, point.rays.second)) {
      return std::nullopt;
    }
    true_mm3 += point.share_mm2 * point.point_mm.z();
  }
  const CameraProblem problem(points, assumed.pinhole.mean_focal_px());
  minimise<kCameraPair>(problem, LevenbergMarquardtParams{}, cameras);
  const Pose table_from_first = cameras[0].inverse();
  double column_mm3 = 0.0;
  double spread_mm2 = 0.0;
  double true_spread_mm2 = 0.0;
  for (const MealPoint& point : points) {
    if (point.known != Known::nothing) continue;
    Vec3 found;
    if (!triangulate(point.rays, second_from_first(cameras), found)) return std::nullopt;
    const Vec3 on_table = table_from_first * found;
    column_mm3 += point.share_mm2 * on_table.z();
    spread_mm2 += on_table.head<2>().squaredNorm();
    true_spread_mm2 += point.point_mm.head<2>().squaredNorm();
  }
  // The ground that a point stands for grows as the square of the distances between points.
  return column_mm3 * (spread_mm2 / true_spread_mm2) / true_mm3 - 1.0;
}

}  // namespace traygauge
