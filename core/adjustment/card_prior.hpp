// What the card's alignment in one view says about the camera, once the card may lie a little askew.
#pragma once

#include "core/geometry/geometry.hpp"
#include "core/geometry/table_frame.hpp"

namespace traygauge {

// A view's alignment with the print, as if the card lay flat on the table; the information is that of a step
// as in `moved`.
struct CardPrior {
  Pose camera_from_table;
  Mat6 information = Mat6::Zero();
};

// How the card lies against the table: turned by `tilt_rad` about the table's x and y through `pivot_mm`, the
// middle of its print, and raised.
struct CardTilt {
  Vec2 tilt_rad = Vec2::Zero();
  double raised_mm = 0.0;

  Pose table_from_card(const Vec3& pivot_mm) const {
    const Mat3 turn = rotation_about({tilt_rad.x(), tilt_rad.y(), 0.0});
    return {turn, pivot_mm + raised_mm * Vec3::UnitZ() - turn * pivot_mm};
  }
};

// The step from the alignment to the card where camera and lie put it.
inline Vec6 card_deviation(const CardPrior& alignment, const Pose& camera_from_card) {
  return step_between(alignment.camera_from_table, camera_from_card);
}

// Its derivatives by a step of camera_from_table and by the lie (tilt, raised).
inline Mat6 deviation_by_camera(const Pose& camera_from_table, const Pose& table_from_card) {
  Mat6 derivative = Mat6::Identity();
  derivative.block<3, 3>(3, 0) = -skew(camera_from_table.rotation * table_from_card.translation);
  return derivative;
}

inline Eigen::Matrix<double, 6, 3> deviation_by_lie(const Pose& camera_from_table,
                                                    const Pose& table_from_card, const Vec3& pivot_mm) {
  const Mat3& rotation = camera_from_table.rotation;
  const Mat3 lever = rotation * skew(table_from_card.rotation * pivot_mm);
  Eigen::Matrix<double, 6, 3> derivative;
  derivative.block<3, 2>(0, 0) = rotation.leftCols<2>();
  derivative.block<3, 2>(3, 0) = lever.leftCols<2>();
  derivative.col(2) << Vec3::Zero(), rotation.col(2);
  return derivative;
}

}  // namespace traygauge
