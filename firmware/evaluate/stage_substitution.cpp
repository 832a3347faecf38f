#include "firmware/evaluate/stage_substitution.hpp"

#include <cmath>
#include <numbers>

namespace traygauge {
namespace {

// A turn about the vertical and a shift on the table, the nearest to `pose`.
Pose upright(const Pose& pose) {
  const double azimuth = std::atan2(pose.rotation(1, 0), pose.rotation(0, 0));
  return {rotation_about({0.0, 0.0, azimuth}), {pose.translation.x(), pose.translation.y(), 0.0}};
}

// Where the line of sight to `target`, in the camera, meets the plane z = height of the table.
Vec2 on_plane(const Pose& camera_from_table, const Vec3& target, double height_mm) {
  const Vec3 eye = camera_centre_mm(camera_from_table);
  const Vec3 sight = camera_from_table.rotation.transpose() * target;
  return (eye + (height_mm - eye.z()) / sight.z() * sight).head<2>();
}

Vec3 in_camera(const Pose& camera_from_table, const DishPose& place) {
  return camera_from_table * Vec3(place.centre_mm.x(), place.centre_mm.y(), place.edge_height_mm);
}

constexpr int kComparisonStep = 2;  // of the samples compared, in rows and columns

}  // namespace

void StageSubstitution::on_order(int first_view) {
  camera_from_world_ = {pair_.first_from_world, pair_.second_from_world};
  if (first_view == 1) std::swap(camera_from_world_[0], camera_from_world_[1]);
}

void StageSubstitution::on_geometry(BundleResult& bundle, std::span<const DishOnTray> dishes) {
  const bool moves_cameras =
      is_replaced(TrueStage::pose) || is_replaced(TrueStage::scale) || is_replaced(TrueStage::table);
  if (!moves_cameras && !is_replaced(TrueStage::place)) return;  // to the last bit
  TableCameras& cameras = bundle.camera_from_table;
  const TableCameras found = cameras;
  const Pose motion = second_from_first(found);
  const Pose true_motion = second_from_first(camera_from_world_);
  if (is_replaced(TrueStage::table)) {
    cameras[0] = camera_from_world_[0] * upright(camera_from_world_[0].inverse() * found[0]);
  }
  const double scale =
      is_replaced(TrueStage::scale) ? true_motion.translation.norm() / motion.translation.norm() : 1.0;
  const Pose pose = is_replaced(TrueStage::pose) ? true_motion : motion;
  const double baseline_mm = motion.translation.norm() * scale;
  // Without a table of its own the scene grows about the table's origin, and its planes with it.
  if (!is_replaced(TrueStage::table)) cameras[0].translation *= scale;
  cameras[1] = Pose{pose.rotation, baseline_mm * pose.translation.normalized()} * cameras[0];
  for (std::size_t d = 0; d < dishes.size(); ++d) {
    BundleDishResult& dish = bundle.dishes[d];
    if (!dish.status.ok()) continue;
    DishPose& place = dish.placed.place;
    Vec3 target = in_camera(found[0], place);
    const auto truth = is_replaced(TrueStage::place) ? true_place(truth_, dishes[d].label) : std::nullopt;
    if (truth) {
      target = camera_from_world_[0] * Vec3(truth->centre_mm[0], truth->centre_mm[1], place.edge_height_mm);
      const double rotation = truth->rotation_deg * std::numbers::pi / 180.0;
      const Vec3 axis = cameras[0].rotation.transpose() * camera_from_world_[0].rotation *
                        Vec3(std::cos(rotation), std::sin(rotation), 0.0);
      place.azimuth_rad = std::atan2(axis.y(), axis.x());
    }
    place.centre_mm = on_plane(cameras[0], target, place.edge_height_mm);
  }
}

void StageSubstitution::on_surfaces(const TableCameras& camera_from_table,
                                    std::array<SurfaceGrid, 2>& grids) {
  if (!surface_) return;
  for (std::size_t v = 0; v < 2; ++v) {
    const Pose world_from_table = camera_from_world_[v].inverse() * camera_from_table[v];
    if (replaced_ == TrueStages{}) compare_surface(world_from_table, grids[v]);
    if (is_replaced(TrueStage::surface)) replace_surface(world_from_table, grids[v], kept_[v]);
  }
}

// The line of sight is the true camera's, so that errors of the pose do not count here.
std::optional<SurfacePoint> StageSubstitution::true_point(const Pose& world_from_table, const Vec3& camera_mm,
                                                          const SurfacePoint& found) const {
  const Vec3 sight = Vec3(found.x_mm, found.y_mm, found.z_mm) - camera_mm;
  const double distance_mm = sight.norm();
  const auto expected_mm = surface_->distance_mm(
      world_from_table * camera_mm, world_from_table.rotation * sight / distance_mm, distance_mm);
  if (!expected_mm) return {};
  const Eigen::Vector3f point = (camera_mm + *expected_mm / distance_mm * sight).cast<float>();
  return SurfacePoint{point.x(), point.y(), point.z()};
}

void StageSubstitution::compare_surface(const Pose& world_from_table, const SurfaceGrid& grid) {
  for (int y = 0; y < grid.points.height; y += kComparisonStep) {
    for (int x = 0; x < grid.points.width; x += kComparisonStep) {
      const std::uint8_t label = grid.labels.at(x, y);
      const SurfaceEvidence evidence = grid.evidence.at(x, y);
      if (label == 0 || evidence == SurfaceEvidence::none) continue;
      HeightErrors& errors = height_errors_[label];
      ++errors.samples;
      if (evidence == SurfaceEvidence::filled) continue;
      ++errors.matched;
      const SurfacePoint& found = grid.points.at(x, y);
      if (const auto truth = true_point(world_from_table, grid.camera_mm, found))
        errors.errors_mm.push_back(static_cast<double>(found.z_mm - truth->z_mm));
    }
  }
}

void StageSubstitution::replace_surface(const Pose& world_from_table, SurfaceGrid& grid,
                                        ReplacedGrid& kept) const {
  const auto width = static_cast<std::size_t>(grid.points.width);
  kept.points.assign(width * static_cast<std::size_t>(grid.points.height), {});
  kept.evidence.assign(kept.points.size(), SurfaceEvidence::none);
  for (int y = 0; y < grid.points.height; ++y) {
    for (int x = 0; x < grid.points.width; ++x) {
      const std::size_t at = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
      kept.points[at] = grid.points.at(x, y);
      kept.evidence[at] = grid.evidence.at(x, y);
      if (grid.evidence.at(x, y) == SurfaceEvidence::none) continue;
      const auto truth = true_point(world_from_table, grid.camera_mm, kept.points[at]);
      if (!truth) continue;
      kept.points[at] = *truth;
      kept.evidence[at] = SurfaceEvidence::both;
    }
  }
  grid.points = {kept.points.data(), grid.points.width, grid.points.height};
  grid.evidence = {kept.evidence.data(), grid.evidence.width, grid.evidence.height};
}

}  // namespace traygauge
