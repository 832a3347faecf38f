#include "core/volume/uncertainty.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/units.hpp"

namespace traygauge {
namespace {

// The point nearest to both cameras' rays, when the cameras are where `cameras` says and see it as `rays`.
Vec3 triangulate(const TableCameras& cameras, const std::array<Vec3, 2>& rays) {
  Mat3 normal = Mat3::Zero();
  Vec3 right = Vec3::Zero();
  for (std::size_t v = 0; v < 2; ++v) {
    const Vec3 direction = (cameras[v].rotation.transpose() * rays[v]).normalized();
    const Mat3 across = Mat3::Identity() - direction * direction.transpose();
    normal += across;
    right += across * camera_centre_mm(cameras[v]);
  }
  return normal.inverse() * right;
}

// Outline of an area, were it round: items are compact.
double outline_mm(double area_mm2) {
  return 2.0 * std::sqrt(std::numbers::pi * area_mm2);
}

}  // namespace

double height_sigma_mm(const Vec3& point_mm, const TableCameras& camera_from_table,
                       const BundleMatrix& covariance) {
  constexpr double kStep = 1e-4;  // rad or mm: far above rounding, far below what bends the derivatives
  const std::array<Vec3, 2> rays = {camera_from_table[0] * point_mm, camera_from_table[1] * point_mm};
  Eigen::Matrix<double, 12, 1> slope;
  for (int i = 0; i < 12; ++i) {
    TableCameras stepped = camera_from_table;
    auto& camera = stepped[i < 6 ? 0 : 1];
    camera = moved(camera, kStep * Eigen::Matrix<double, 6, 1>::Unit(i % 6));
    slope[i] = (triangulate(stepped, rays).z() - point_mm.z()) / kStep;
  }
  return std::sqrt(std::max(0.0, slope.dot(covariance.topLeftCorner<12, 12>() * slope)));
}

double estimate_sigma_ml(const UncertaintyInput& input, const TableCameras& camera_from_table,
                         const BundleMatrix& covariance, const UncertaintyParams& params) {
  const HeightVolume& item = input.volume;
  if (!(item.area_mm2 > 0.0)) return 0.0;
  const double volume_mm3 = kMm3PerMl * item.column_volume_ml;
  const double cameras_mm = height_sigma_mm(item.centre_mm, camera_from_table, covariance);
  const double matching_mm = params.disparity_bias_px * input.height_per_px_mm;
  const double edge_mm =
      std::hypot(params.outline_px * input.px_mm, input.is_outline_found ? params.found_outline_mm : 0.0);
  const double edge_mm3 = outline_mm(item.area_mm2) * edge_mm * 0.5 * item.mean_height_mm;
  const double wall_mm3 = params.wall_mm * item.wall_mm2;
  const double unmatched_fraction = input.is_round
                                        ? params.round_fraction
                                        : params.filled_fraction * std::pow(1.0 - input.matched_fraction, 2);
  const double variance_mm6 =
      item.area_mm2 * item.area_mm2 *
          (cameras_mm * cameras_mm + matching_mm * matching_mm + params.height_mm * params.height_mm +
           input.dish_sigma_mm * input.dish_sigma_mm) +
      std::pow(params.hidden_fraction * kMm3PerMl * item.hidden_volume_ml, 2) + edge_mm3 * edge_mm3 +
      wall_mm3 * wall_mm3 + std::pow(unmatched_fraction * volume_mm3, 2) +
      std::pow(kMm3PerMl * item.closing_sigma_ml, 2);
  return std::sqrt(variance_mm6) / kMm3PerMl;
}

}  // namespace traygauge
