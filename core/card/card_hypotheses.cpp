#include "core/card/card_hypotheses.hpp"

#include <Eigen/LU>

#include "core/card/card_pose.hpp"
#include "core/card/homography.hpp"

namespace traygauge {
namespace {

Pose table_pose(const Pose& camera_from_card, double thickness_mm) {
  Pose card_from_table;
  card_from_table.rotation = Vec3(1.0, -1.0, -1.0).asDiagonal();
  card_from_table.translation = Vec3(0.0, 0.0, thickness_mm);
  return camera_from_card * card_from_table;
}

}  // namespace

std::array<Vec2, 4> print_corners_mm(const CardModelSize& size) {
  return {Vec2(0.0, 0.0), Vec2(size.width_mm, 0.0), Vec2(size.width_mm, size.height_mm),
          Vec2(0.0, size.height_mm)};
}

void list_poses(const CardOutline& outline, const CardModelSize& size, BoundedList<Pose>& poses) {
  const std::array<Vec2, 4> print = print_corners_mm(size);
  const Vec3 centre(0.5 * size.width_mm, 0.5 * size.height_mm, 0.0);
  for (std::size_t turn = 0; turn < 4; ++turn) {
    std::array<Vec2, 4> rays;
    for (std::size_t i = 0; i < 4; ++i) rays[i] = outline.corners[(i + turn) % 4];
    Mat3 print_from_ray;
    Pose camera_from_card;
    if (!homography_from_four(rays, print, print_from_ray)) continue;
    if (!pose_from_homography(print_from_ray, camera_from_card)) continue;
    poses.push_back(table_pose(camera_from_card, size.thickness_mm));
    poses.push_back(table_pose(mirrored_pose(camera_from_card, centre), size.thickness_mm));
  }
}

bool complete_outline(const CardOutline& outline, std::size_t hidden, double opposite_mm, double beside_mm,
                      CardOutline& completed) {
  const auto corner = [&](std::size_t i) { return Vec3(outline.corners[(hidden + i) % 4].homogeneous()); };
  // Corners 2 and 3 are seen, 0 and 1 hidden; the sides 1-2 and 3-0 beside.
  const Vec3 beside_second = corner(1).cross(corner(2));
  const Vec3 beside_third = corner(3).cross(corner(0));
  Vec3 away = beside_second.cross(beside_third).normalized();  // in space, along both
  const Vec3 along =
      corner(2).cross(corner(3)).cross(away).normalized();  // of the third, by its plane through the eye
  // depth_3 · corner(3) = depth_2 · corner(2) ± opposite_mm · along
  Eigen::Matrix<double, 3, 2> ends;
  ends << corner(2), -corner(3);
  const Vec2 depths = -(ends.transpose() * ends).inverse() * (ends.transpose() * along) * opposite_mm;
  const double sign = depths.x() > 0.0 ? 1.0 : -1.0;
  if (!depths.allFinite() || !(sign * depths.y() > 0.0)) return false;
  const Vec3 second = sign * depths.x() * corner(2);
  const Vec3 third = sign * depths.y() * corner(3);
  // From the third side to the hidden one: towards where the outline's own corner lies.
  const Vec2 step = (second + away).hnormalized() - second.hnormalized();
  if (step.dot(outline.corners[(hidden + 1) % 4] - outline.corners[(hidden + 2) % 4]) < 0.0) away = -away;
  const Vec3 first = second + beside_mm * away;
  const Vec3 zeroth = third + beside_mm * away;
  if (!(first.z() > 0.0) || !(zeroth.z() > 0.0)) return false;
  completed = outline;
  completed.corners[(hidden + 1) % 4] = first.hnormalized();
  completed.corners[hidden] = zeroth.hnormalized();
  return completed.corners[hidden].allFinite() && completed.corners[(hidden + 1) % 4].allFinite();
}

}  // namespace traygauge
