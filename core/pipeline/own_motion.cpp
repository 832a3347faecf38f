#include "core/pipeline/own_motion.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/levenberg_marquardt.hpp"

namespace traygauge {

Pose OwnMotion::pose() const {
  const Mat3 turn = rotation_about(turn_rad * Vec3::UnitZ());
  const Vec3 centre(centre_mm.x(), centre_mm.y(), 0.0);
  const Vec3 shift(shift_mm.x(), shift_mm.y(), 0.0);
  return {turn, centre + shift - turn * centre};
}

OwnMotion OwnMotion::reversed() const {
  OwnMotion back = *this;
  back.centre_mm = centre_mm + shift_mm;
  back.shift_mm = -shift_mm;
  back.turn_rad = -turn_rad;
  return back;
}

OwnMotion find_own_motion(std::span<const SightedDish> dishes, const TableCameras& cameras,
                          const CamerasMatrix& covariance, const TrayCheckParams& params) {
  OwnMotion motion;
  for (const SightedDish& dish : dishes) {
    const DishConsistency consistency =
        compare_sightings(dish.sightings, cameras, covariance, dish.size_mm, params.consistency);
    const double slip_mm = consistency.slip_mm.norm();
    if (consistency.explained_by(DishFault::slip) <= params.max_explained_by_slip ||
        consistency.best_fault() != DishFault::slip || slip_mm < params.least_own_motion_mm)
      return {};
    if (slip_mm > params.most_own_motion_mm) return {.is_too_far = true};
    if (!motion.is_known) {
      motion.is_known = true;
      motion.centre_mm = dish.sightings[0].place_from(cameras[0]).head<2>();
      motion.shift_mm = consistency.slip_mm;
      motion.turn_rad = dish.is_round ? 0.0 : consistency.turn_rad;
      motion.shift_sigma_mm = std::max(params.min_own_sigma_mm, consistency.slip_sigma_mm);
      motion.turn_sigma_rad = dish.is_round ? slip_mm / params.own_turn_lever_mm : params.min_own_turn_rad;
    } else if ((consistency.slip_mm - motion.shift_mm).norm() > params.same_motion_mm) {
      return {};
    }
  }
  return motion;
}

CardPrior card_in_frame_of(const OwnMotion& motion, const CardPrior& second_card) {
  CardPrior card;
  card.camera_from_table = second_card.camera_from_table * motion.pose();
  // A step of the camera by what is not known of the motion: shifts along the table's axes, a turn about the
  // dish.
  const Mat3& rotation = card.camera_from_table.rotation;
  const Vec3 centre(motion.centre_mm.x(), motion.centre_mm.y(), 0.0);
  Eigen::Matrix<double, 6, 3> by_motion = Eigen::Matrix<double, 6, 3>::Zero();
  by_motion.block<3, 2>(3, 0) = rotation.leftCols<2>();
  by_motion.col(2) << rotation.col(2), -rotation * Vec3::UnitZ().cross(centre);
  const Vec3 variances =
      Vec3(motion.shift_sigma_mm, motion.shift_sigma_mm, motion.turn_sigma_rad).array().square();
  const Eigen::Matrix<double, 6, 3> spread = by_motion.lazyProduct(Mat3(variances.asDiagonal()));
  const Mat6 covariance =
      inverse_information<6>(second_card.information) + Mat6(spread.lazyProduct(by_motion.transpose()));
  card.information = inverse_information<6>(covariance);
  return card;
}

}  // namespace traygauge
