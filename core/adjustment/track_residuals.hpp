// What a point track says about two cameras over a table: how far its second place lies off the epipolar line
// of the first, and, for a point of the table, how far along that line from where the table is.
//
// The first place defines the point, the second is measured; both residuals are in pixels of the second
// picture and independent of each other. They depend on nine parameters: a step of second_from_first as in
// `moved`, and the table's plane in the first camera as m with m · x = 1. The chain rule to steps of both
// camera_from_table is applied once to the sums.
#pragma once

#include "core/geometry/geometry.hpp"
#include "core/geometry/levenberg_marquardt.hpp"
#include "core/geometry/table_frame.hpp"
#include "core/tracking/point_track.hpp"

namespace traygauge {

inline constexpr int kPairParameters = kPoseParameters + Vec3::SizeAtCompileTime;
using PairVector = Eigen::Matrix<double, kPairParameters, 1>;
using PairMatrix = Eigen::Matrix<double, kPairParameters, kPairParameters>;
using PairByCameras = Eigen::Matrix<double, kPairParameters, kCameraParameters>;

class TrackResiduals {
 public:
  TrackResiduals(const TableCameras& camera_from_table, double focal_px);

  // False on an epipole.
  bool off_line(const PointTrack& track, double& residual_px) const;
  // With derivatives by the first six parameters.
  bool off_line(const PointTrack& track, double& residual_px, Eigen::Matrix<double, 6, 1>& by_pair) const;

  // False where the line of sight does not meet the table in front of both cameras.
  bool along_line(const PointTrack& track, double& residual_px) const;
  // `by_height_px`: what a millimetre over the table would move it.
  bool along_line(const PointTrack& track, double& residual_px, PairVector& by_pair,
                  double& by_height_px) const;

  PairByCameras by_cameras() const;

 private:
  TableCameras cameras_;
  double focal_px_;
  Pose second_from_first_;
  Mat3 essential_;
  Vec3 table_normal_;    // in the first camera
  double table_offset_;  // normal · x of the table's points; negative in front of the camera
  Vec3 table_;           // m
};

}  // namespace traygauge
