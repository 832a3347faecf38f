#include "core/adjustment/track_residuals.hpp"

#include <cmath>

namespace traygauge {
namespace {

struct EpipolarLine {
  Vec3 line = Vec3::Zero();  // in the second view
  double normal = 0.0;
};

bool find_line(const Mat3& essential, const PointTrack& track, EpipolarLine& epipolar) {
  epipolar.line = essential * track.first.homogeneous();
  epipolar.normal = epipolar.line.head<2>().norm();
  return epipolar.normal > kRounding;
}

}  // namespace

TrackResiduals::TrackResiduals(const TableCameras& camera_from_table, double focal_px)
    : cameras_(camera_from_table),
      focal_px_(focal_px),
      second_from_first_(second_from_first(camera_from_table)),
      essential_(essential_matrix(second_from_first_)),
      table_normal_(camera_from_table[0].rotation.col(2)),
      table_offset_(table_normal_.dot(camera_from_table[0].translation)),
      table_(table_normal_ / table_offset_) {}

bool TrackResiduals::off_line(const PointTrack& track, double& residual_px) const {
  EpipolarLine epipolar;
  if (!find_line(essential_, track, epipolar)) return false;
  residual_px = focal_px_ * track.second.homogeneous().dot(epipolar.line) / epipolar.normal;
  return true;
}

bool TrackResiduals::off_line(const PointTrack& track, double& residual_px,
                              Eigen::Matrix<double, 6, 1>& by_pair) const {
  EpipolarLine epipolar;
  if (!find_line(essential_, track, epipolar)) return false;
  const Vec3 second = track.second.homogeneous();
  const double constraint = second.dot(epipolar.line);
  const double scale = focal_px_ / epipolar.normal;
  residual_px = constraint * scale;
  // d(c / n) = (dc − c n·dn / n²) / n, all by the line; the line is t × R x.
  const Vec3 unit(epipolar.line.x(), epipolar.line.y(), 0.0);
  const Vec3 by_line = scale * (second - constraint / (epipolar.normal * epipolar.normal) * unit);
  const Vec3 turned = second_from_first_.rotation * track.first.homogeneous();
  by_pair << turned.cross(by_line.cross(second_from_first_.translation)), turned.cross(by_line);
  return true;
}

bool TrackResiduals::along_line(const PointTrack& track, double& residual_px) const {
  EpipolarLine epipolar;
  if (!find_line(essential_, track, epipolar)) return false;
  const Vec3 ray = track.first.homogeneous();
  const double depth = 1.0 / table_.dot(ray);
  if (!(depth > 0.0)) return false;
  const Vec3 point = depth * (second_from_first_.rotation * ray) + second_from_first_.translation;
  if (!(point.z() > 0.0)) return false;
  const Vec2 along = Vec2(-epipolar.line.y(), epipolar.line.x()) / epipolar.normal;
  residual_px = focal_px_ * along.dot(track.second - point.head<2>() / point.z());
  return std::isfinite(residual_px);
}

bool TrackResiduals::along_line(const PointTrack& track, double& residual_px, PairVector& by_pair,
                                double& by_height_px) const {
  EpipolarLine epipolar;
  if (!find_line(essential_, track, epipolar)) return false;
  const Vec3 ray = track.first.homogeneous();
  const double depth = 1.0 / table_.dot(ray);
  if (!(depth > 0.0)) return false;
  const Vec3 turned = second_from_first_.rotation * ray;
  const Vec3 point = depth * turned + second_from_first_.translation;
  if (!(point.z() > 0.0)) return false;
  const Vec2 along = Vec2(-epipolar.line.y(), epipolar.line.x()) / epipolar.normal;
  const Vec2 expected = point.head<2>() / point.z();
  residual_px = focal_px_ * along.dot(track.second - expected);
  // The line's own turn moves the residual by the distance off it: left out.
  const Vec3 by_point = -focal_px_ / point.z() * Vec3(along.x(), along.y(), -along.dot(expected));
  const double by_depth = by_point.dot(turned);
  by_pair << depth * turned.cross(by_point), by_point, -depth * depth * by_depth * ray;
  by_height_px = by_depth / table_normal_.dot(ray);
  return std::isfinite(residual_px);
}

PairByCameras TrackResiduals::by_cameras() const {
  const Mat3& turn = second_from_first_.rotation;
  const Pose& first = cameras_[0];
  const Mat3 lever = skew(turn * first.translation);
  PairByCameras chain = PairByCameras::Zero();
  // second_from_first = second * first⁻¹: both turns are in the second camera's axes.
  chain.block<3, 3>(0, 0) = -turn;
  chain.block<3, 3>(3, 0) = -lever * turn;
  chain.block<3, 3>(3, 3) = -turn;
  chain.block<3, 3>(0, 6).setIdentity();
  chain.block<3, 3>(3, 6) = lever;
  chain.block<3, 3>(3, 9).setIdentity();
  // m = n / (n · t), n turning with the first camera.
  const Vec3& n = table_normal_;
  const double inverse = 1.0 / table_offset_;
  chain.block<3, 3>(6, 0) =
      -inverse * skew(n) - inverse * inverse * n * n.cross(first.translation).transpose();
  chain.block<3, 3>(6, 3) = -inverse * inverse * n * n.transpose();
  return chain;
}

}  // namespace traygauge
