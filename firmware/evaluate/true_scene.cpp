#include "firmware/evaluate/true_scene.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/measure/pair_setup.hpp"
#include "simulator/capture/picture_file.hpp"

namespace traygauge {
namespace {

constexpr double kDepthUnitMm = 0.02;
// Searched in front of and behind the distance expected, in steps finer than food's thinnest edge.
constexpr double kSearchBeforeMm = 40.0;
constexpr double kSearchBehindMm = 20.0;
constexpr double kSearchStepMm = 1.0;
constexpr int kBisections = 7;
// A line of sight that passes from before to behind the surface by more at once went past an edge.
constexpr double kEdgeMm = 0.5;

}  // namespace

Pose pose_of(const WorldToCamera& matrix) {
  Pose pose;
  for (int row = 0; row < 3; ++row) {
    const auto& values = matrix[static_cast<std::size_t>(row)];
    for (int column = 0; column < 3; ++column)
      pose.rotation(row, column) = values[static_cast<std::size_t>(column)];
    pose.translation[row] = values[3];
  }
  return pose;
}

std::optional<TruthDish> true_place(const Truth& truth, std::uint8_t label) {
  if (truth.dishes.empty()) return TruthDish{label, {}, 0.0};
  const auto found = std::find_if(truth.dishes.begin(), truth.dishes.end(),
                                  [&](const TruthDish& dish) { return dish.label == label; });
  return found == truth.dishes.end() ? std::nullopt : std::optional(*found);
}

std::optional<TrueSurface> TrueSurface::read(const Capture& capture, const Truth& truth) {
  const std::filesystem::path file = capture.file.parent_path() / "depth_0.png";
  std::error_code ignored;
  if (truth.poses.empty() || !std::filesystem::exists(file, ignored)) return {};
  TrueSurface surface;
  const CameraDescription& camera = capture.views.front().camera;
  surface.lens_ = lens_of(camera);
  surface.camera_from_world_ = pose_of(truth.poses.front());
  surface.depth_ = read_depth_picture({file, ""}, camera.size);
  return surface;
}

std::optional<double> TrueSurface::behind_mm(const Vec3& world_mm) const {
  const Vec3 point = camera_from_world_ * world_mm;
  if (!(point.z() > 0.0)) return {};
  const Vec2 pixel = lens_.pixel(point.hnormalized());
  const double left = std::floor(pixel.x());
  const double top = std::floor(pixel.y());
  const ImageView<const std::uint16_t> depth = depth_.view();
  if (!(left >= 0.0 && top >= 0.0 && left + 1.0 < depth.width && top + 1.0 < depth.height)) return {};
  const int x = static_cast<int>(left);
  const int y = static_cast<int>(top);
  const double u = pixel.x() - left;
  const double v = pixel.y() - top;
  const std::array<double, 4> corners = {kDepthUnitMm * depth.at(x, y), kDepthUnitMm * depth.at(x + 1, y),
                                         kDepthUnitMm * depth.at(x, y + 1),
                                         kDepthUnitMm * depth.at(x + 1, y + 1)};
  const auto [nearest, farthest] = std::minmax_element(corners.begin(), corners.end());
  if (!(*nearest > 0.0)) return {};
  // Between samples on either side of an edge there is no surface: the nearest pixel says which side it is.
  constexpr double kMaxSlopeMm = 3.0;
  const double surface_mm = *farthest - *nearest > kMaxSlopeMm
                                ? corners[(u >= 0.5 ? 1U : 0U) + (v >= 0.5 ? 2U : 0U)]
                                : (1.0 - v) * ((1.0 - u) * corners[0] + u * corners[1]) +
                                      v * ((1.0 - u) * corners[2] + u * corners[3]);
  return point.z() - surface_mm;
}

std::optional<double> TrueSurface::distance_mm(const Vec3& eye_mm, const Vec3& direction,
                                               double about_mm) const {
  const auto behind = [&](double distance) { return behind_mm(eye_mm + distance * direction); };
  double before = about_mm - kSearchBeforeMm;
  if (!(behind(before).value_or(1.0) < 0.0)) return {};
  constexpr int kSteps = static_cast<int>((kSearchBeforeMm + kSearchBehindMm) / kSearchStepMm);
  for (int step = 1; step <= kSteps; ++step) {
    double after = about_mm - kSearchBeforeMm + step * kSearchStepMm;
    const auto depth = behind(after);
    if (!depth) return {};
    if (*depth < 0.0) {
      before = after;
      continue;
    }
    for (int i = 0; i < kBisections; ++i) {
      const double middle = 0.5 * (before + after);
      (behind(middle).value_or(0.0) < 0.0 ? before : after) = middle;
    }
    const double found = 0.5 * (before + after);
    const auto rest = behind(found);
    return rest && std::abs(*rest) < kEdgeMm ? std::optional(found) : std::nullopt;
  }
  return {};
}

}  // namespace traygauge
