#include "core/dish/dish_consistency.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace traygauge {
namespace {

// How far the centre moved (2), and the sizes that both views show.
using Evidence = Eigen::Matrix<double, 4, 1>;
using EvidenceMatrix = Eigen::Matrix4d;

// The amount of one fault that explains the evidence best; its sigma; what is left unexplained.
double explain(const Evidence& evidence, const EvidenceMatrix& information, const Evidence& by_fault,
               double& sigma, double& left) {
  const double weight = by_fault.dot(information * by_fault);
  const double amount = by_fault.dot(information * evidence) / weight;
  sigma = 1.0 / std::sqrt(weight);
  const Evidence rest = evidence - amount * by_fault;
  left = rest.dot(information * rest);
  return amount;
}

// Both views together. Their cameras may be off, and the dish may lean by itself, with sigma own_lean_rad.
void find_lean(const std::array<DishSighting, 2>& sightings, const TableCameras& cameras,
               const CamerasMatrix& covariance, double own_lean_rad, DishConsistency& result) {
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  Vec2 weighted = Vec2::Zero();
  Eigen::Matrix<double, 2, kCameraParameters> by_cameras;
  for (std::size_t v = 0; v < 2; ++v) {
    const SightedLean& lean = sightings[v].lean;
    const Eigen::Matrix<double, 2, 6> by_camera = lean.by_camera.cast<double>();
    information += lean.information.cast<double>();
    weighted += lean.weighted.cast<double>() +
                by_camera.lazyProduct(step_between(sightings[v].camera_from_table, cameras[v]));
    by_cameras.middleCols<6>(6 * static_cast<Eigen::Index>(v)) = by_camera;
  }
  if (!(information.determinant() > 0.0)) return;
  const Eigen::Matrix2d inverse = information.inverse();
  const Eigen::Matrix<double, 2, kCameraParameters> by_camera_errors = by_cameras.lazyProduct(covariance);
  const Eigen::Matrix2d of_cameras = by_camera_errors.lazyProduct(by_cameras.transpose());
  const Eigen::Matrix2d spread =
      inverse + inverse * of_cameras * inverse + own_lean_rad * own_lean_rad * Eigen::Matrix2d::Identity();
  const Vec2 lean = inverse * weighted;
  result.lean_rad = lean.norm();
  const Vec2 along = result.lean_rad > 0.0 ? Vec2(lean / result.lean_rad) : Vec2::UnitX();
  result.lean_sigma_rad = std::sqrt(along.dot(spread * along));
  result.lean_deviation = lean.dot(spread.inverse() * lean);
}

}  // namespace

std::array<DishFault, kDishFaults> DishConsistency::best_first() const {
  std::array<DishFault, kDishFaults> faults{DishFault::slip, DishFault::scale, DishFault::height};
  const auto unexplained = [&](DishFault fault) {
    return left[static_cast<std::size_t>(fault)] + (fault == DishFault::slip ? 1.0 : 0.0);
  };
  std::ranges::sort(faults, {}, unexplained);
  return faults;
}

DishConsistency compare_sightings(const std::array<DishSighting, 2>& sightings, const TableCameras& cameras,
                                  const CamerasMatrix& covariance, double size_mm,
                                  const DishConsistencyParams& params) {
  // What a sighting in the first and in the second view adds to the evidence.
  EvidenceMatrix of_first;
  of_first << -1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0;
  EvidenceMatrix of_second;
  of_second << 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1;
  const SightedVector first = sightings[0].place_from(cameras[0]);
  const SightedVector second = sightings[1].place_from(cameras[1]);
  const Evidence evidence = of_first * first + of_second * second;
  // A dish that stands higher looks like one as described that is taken for lower.
  const Evidence by_height = -(of_first * sightings[0].by_height + of_second * sightings[1].by_height);
  const Evidence by_size(0.0, 0.0, 1.0, 1.0);
  Eigen::Matrix<double, 4, kCameraParameters> by_cameras;
  by_cameras << of_first.lazyProduct(sightings[0].by_camera), of_second.lazyProduct(sightings[1].by_camera);
  // Products of this size by Eigen's blocked kernel would allocate.
  const Eigen::Matrix<double, 4, kCameraParameters> by_camera_errors = by_cameras.lazyProduct(covariance);
  const double size_sigma = params.size_sigma_mm / size_mm;
  const EvidenceMatrix spread =
      of_first * sightings[0].covariance * of_first.transpose() +
      of_second * sightings[1].covariance * of_second.transpose() +
      Eigen::Matrix4d(by_camera_errors.lazyProduct(by_cameras.transpose())) +
      size_sigma * size_sigma * by_size * by_size.transpose() +
      params.height_sigma_mm * params.height_sigma_mm * by_height * by_height.transpose();
  const EvidenceMatrix information = spread.inverse();

  DishConsistency result;
  result.squared_deviation = evidence.dot(information * evidence);
  const auto left = [&](DishFault fault) -> double& { return result.left[static_cast<std::size_t>(fault)]; };
  result.scale = explain(evidence, information, by_size, result.scale_sigma, left(DishFault::scale));
  result.height_mm =
      explain(evidence, information, by_height, result.height_sigma_mm, left(DishFault::height));
  // A slip explains the motion of the centre, whatever it is; with it the sizes say what they say by
  // themselves.
  const Eigen::Vector2d sizes = evidence.tail<2>();
  left(DishFault::slip) = sizes.dot(spread.bottomRightCorner<2, 2>().inverse() * sizes);
  const Eigen::Matrix2d slip_covariance = information.topLeftCorner<2, 2>().inverse();
  result.slip_mm =
      evidence.head<2>() - spread.topRightCorner<2, 2>() * spread.bottomRightCorner<2, 2>().inverse() * sizes;
  const double slip_mm = result.slip_mm.norm();
  const Vec2 along = slip_mm > 0.0 ? Vec2(result.slip_mm / slip_mm) : Vec2::UnitX();
  result.slip_sigma_mm = std::sqrt(along.dot(slip_covariance * along));
  result.turn_rad = second[kPlaceAzimuth] - first[kPlaceAzimuth];
  const double own_lean_rad = std::numbers::sqrt2 * params.edge_sigma_mm / size_mm;
  find_lean(sightings, cameras, covariance, own_lean_rad, result);
  return result;
}

}  // namespace traygauge
