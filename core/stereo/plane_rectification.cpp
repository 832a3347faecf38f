#include "core/stereo/plane_rectification.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace traygauge {
namespace {

constexpr double kFarthestMeetingMm = 1e7;     // rows that meet farther away are parallel within 1e-4 mm
constexpr double kLeastCameraHeightMm = 50.0;  // above the plane

// The outline on the plane of what has one of `measured`, picture row by picture row.
template <class Visit>
void visit_outline(const StoredView& view, const LabelTable& measured, double plane_height_mm, int step_px,
                   Visit&& visit) {
  const Pose table_from_camera = view.camera_from_table.inverse();
  const Vec3& camera_mm = table_from_camera.translation;
  const auto visit_pixel = [&](int x, int y) {
    Vec2 ray;
    if (!view.lens.undistort_pixel(Vec2(x, y), ray)) return;
    const Vec3 direction = table_from_camera.rotation * Vec3(ray.x(), ray.y(), 1.0);
    if (!(direction.z() < 0.0)) return;
    const Vec3 point = camera_mm + direction * ((plane_height_mm - camera_mm.z()) / direction.z());
    visit(Vec2(point.head<2>()));
  };
  for (int y = view.dish.top; y < view.dish.bottom; y += step_px) {
    const std::uint8_t* labels = view.labels.row(y);
    int left = view.dish.left;
    while (left < view.dish.right && measured[labels[left]] == 0) ++left;
    if (left == view.dish.right) continue;
    int right = view.dish.right - 1;
    while (measured[labels[right]] == 0) --right;
    visit_pixel(left, y);
    visit_pixel(right, y);
  }
}

Vec2 normal_of(const Vec2& direction) {
  return {-direction.y(), direction.x()};
}

bool shows(const StoredView& view, const LabelTable& wanted, int step_px) {
  for (int y = view.dish.top; y < view.dish.bottom; y += step_px) {
    const std::uint8_t* labels = view.labels.row(y);
    const auto is_wanted = [&wanted](std::uint8_t label) { return wanted[label] != 0; };
    if (std::any_of(labels + view.dish.left, labels + view.dish.right, is_wanted)) return true;
  }
  return false;
}

// The food of a dish; all of a bare dish, or of one that is itself to be measured.
LabelTable measured_labels(const std::array<StoredView, 2>& views, const LabelTable& kept,
                           const PlaneRectificationParams& params) {
  if (params.whole_dish) return kept;
  LabelTable food{};
  std::copy(kept.begin() + kFirstItemLabel, kept.begin() + kLastItemLabel + 1,
            food.begin() + kFirstItemLabel);
  const bool is_bare =
      !shows(views[0], food, params.outline_step_px) && !shows(views[1], food, params.outline_step_px);
  return is_bare ? kept : food;
}

// Of the plane, along a level direction, in the view that shows more of it.
double finest_px_mm(const std::array<StoredView, 2>& views, const Vec2& at_mm, double plane_height_mm) {
  double finest_mm = std::numeric_limits<double>::infinity();
  for (const StoredView& view : views) {
    const Vec3 seen = view.camera_from_table * Vec3(at_mm.x(), at_mm.y(), plane_height_mm);
    finest_mm = std::min(finest_mm, seen.z() / view.lens.pinhole.mean_focal_px());
  }
  return finest_mm;
}

// Where the rows meet: the baseline's point on the plane, or far away on it.
Vec2 meeting_point(const std::array<Vec3, 2>& camera_mm, double plane_height_mm, const Vec2& measured_mm) {
  const Vec3 baseline = camera_mm[1] - camera_mm[0];
  const double height = camera_mm[0].z() - plane_height_mm;
  const Vec2 across = baseline.head<2>();
  const Vec2 first = camera_mm[0].head<2>();
  const double drop = -baseline.z();
  if (across.norm() * height < std::abs(drop) * kFarthestMeetingMm) return first + across * (height / drop);
  return measured_mm + across.normalized() * kFarthestMeetingMm;
}

// Of what is measured, on the plane, seen from where the rows meet.
struct FanExtent {
  double min_mm = std::numeric_limits<double>::infinity();  // distance
  double max_mm = 0.0;
  double min_tangent = std::numeric_limits<double>::infinity();
  double max_tangent = -std::numeric_limits<double>::infinity();
  bool in_front = true;
};

bool is_usable(const StoredView& view) {
  return !view.gray.empty() && !view.labels.empty() && view.gray.width == view.lens.width &&
         view.gray.height == view.lens.height && view.labels.width == view.lens.width &&
         view.labels.height == view.lens.height && !view.dish.empty() && view.dish.left >= 0 &&
         view.dish.top >= 0 && view.dish.right <= view.lens.width && view.dish.bottom <= view.lens.height;
}

}  // namespace

LabelTable labels_on_dish(const LabelSet& on_dish) {
  LabelTable kept{};
  for (std::size_t value = 0; value < kept.size(); ++value) {
    const auto label = static_cast<std::uint8_t>(value);
    if (on_dish.contains(label)) kept[value] = is_dish(label) ? kDishLabel : label;
  }
  return kept;
}

Status PlaneRectification::build(const std::array<StoredView, 2>& views, const LabelTable& kept,
                                 double plane_height_mm, const PlaneRectificationParams& params,
                                 std::span<PlaneRow> rows) {
  plane_height_mm_ = plane_height_mm;
  for (std::size_t v = 0; v < 2; ++v) {
    if (!is_usable(views[v]) || !shows(views[v], kept, params.outline_step_px))
      return StatusCode::rectification_failed;
    camera_mm_[v] = camera_centre_mm(views[v].camera_from_table);
    if (!(camera_mm_[v].z() - plane_height_mm > kLeastCameraHeightMm))
      return StatusCode::rectification_failed;
  }
  if (!((camera_mm_[1] - camera_mm_[0]).norm() > kNearMm)) return StatusCode::rectification_failed;

  const LabelTable measured = measured_labels(views, kept, params);
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity());
  Vec2 high = -low;
  for (const StoredView& view : views) {
    visit_outline(view, measured, plane_height_mm, params.outline_step_px, [&](const Vec2& point) {
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
    });
  }
  if (!(high.x() > low.x() && high.y() > low.y())) return StatusCode::rectification_failed;
  const Vec2 middle_mm = 0.5 * (low + high);
  const Vec2 meeting_mm = meeting_point(camera_mm_, plane_height_mm, middle_mm);
  const double distance_mm = (middle_mm - meeting_mm).norm();
  if (!(distance_mm > 0.0)) return StatusCode::rectification_failed;
  const Vec2 axis = (middle_mm - meeting_mm) / distance_mm;

  FanExtent extent;
  for (const StoredView& view : views) {
    visit_outline(view, measured, plane_height_mm, params.outline_step_px, [&](const Vec2& point) {
      const Vec2 arm = point - meeting_mm;
      const double along = arm.dot(axis);
      extent.in_front = extent.in_front && along > 0.0;
      const double tangent = arm.dot(normal_of(axis)) / along;
      extent.min_mm = std::min(extent.min_mm, arm.norm());
      extent.max_mm = std::max(extent.max_mm, arm.norm());
      extent.min_tangent = std::min(extent.min_tangent, tangent);
      extent.max_tangent = std::max(extent.max_tangent, tangent);
    });
  }
  if (!extent.in_front || !(extent.max_mm < params.max_fan * extent.min_mm)) {
    return StatusCode::rectification_failed;
  }

  const double length_mm = extent.max_mm - extent.min_mm;
  const double width_mm = (extent.max_tangent - extent.min_tangent) * distance_mm;
  const double margin = 2.0 * params.margin_samples + 1.0;
  // columns · rows = max_samples with columns = length / step + margin, rows = width / step + margin.
  const double a = length_mm * width_mm;
  const double b = margin * (length_mm + width_mm);
  const double c = margin * margin - params.max_samples;
  if (!(c < 0.0)) return StatusCode::rectification_failed;
  column_step_mm_ = std::max((b + std::sqrt(b * b - 4.0 * a * c)) / (-2.0 * c),
                             params.least_step_px * finest_px_mm(views, middle_mm, plane_height_mm));
  columns_ = static_cast<int>(length_mm / column_step_mm_ + margin);
  const int row_count = static_cast<int>(width_mm / column_step_mm_ + margin);
  if (columns_ < 1 || row_count < 1 || row_count > static_cast<int>(rows.size()) ||
      std::int64_t{columns_} * row_count > params.max_samples) {
    return StatusCode::rectification_failed;
  }

  // Disparity grows with the height where columns run away from the meeting point and camera 1 is the lower.
  const bool outward =
      (meeting_mm - camera_mm_[0].head<2>()).norm() > (meeting_mm - camera_mm_[1].head<2>()).norm();
  const double slack_mm = 0.5 * (columns_ - 1) * column_step_mm_ - 0.5 * length_mm;
  const double first_mm = outward ? extent.min_mm - slack_mm : extent.max_mm + slack_mm;
  const double tangent_step = column_step_mm_ / distance_mm;
  const double first_tangent =
      0.5 * (extent.min_tangent + extent.max_tangent) - 0.5 * (row_count - 1) * tangent_step;
  rows_ = rows.first(static_cast<std::size_t>(row_count));
  for (int r = 0; r < row_count; ++r) {
    const double tangent = first_tangent + r * tangent_step;
    const Vec2 away = (axis + tangent * normal_of(axis)) / std::sqrt(1.0 + tangent * tangent);
    PlaneRow& row = rows_[index(r)];
    row.origin_mm = meeting_mm + first_mm * away;
    row.direction = outward ? away : Vec2(-away);
    for (std::size_t v = 0; v < 2; ++v) {
      row.foot_mm[v] = (camera_mm_[v].head<2>() - row.origin_mm).dot(row.direction);
    }
  }
  return StatusCode::ok;
}

Vec3 PlaneRectification::plane_point(double row, double column) const {
  const auto above = static_cast<int>(std::clamp(std::floor(row), 0.0, rows() - 1.0));
  const auto below = std::min(above + 1, rows() - 1);
  const Vec2 upper = rows_[index(above)].origin_mm + column * column_step_mm_ * rows_[index(above)].direction;
  const Vec2 lower = rows_[index(below)].origin_mm + column * column_step_mm_ * rows_[index(below)].direction;
  const Vec2 point = upper + (row - above) * (lower - upper);
  return {point.x(), point.y(), plane_height_mm_};
}

// In the vertical plane of a row a point at height h is seen at s_i, (s_i − foot_i) (1 − h / Z_i) from the
// foot of camera i, that is at foot_i + (s_i − foot_i) (1 − h / Z_i) from the origin, the same for both.
double PlaneRectification::disparity(int row, double column, double height_mm) const {
  const PlaneRow& line = rows_[index(row)];
  const double at_mm = line.foot_mm[0] +
                       (column * column_step_mm_ - line.foot_mm[0]) * (1.0 - height_mm / camera_height_mm(0));
  const double second_mm =
      line.foot_mm[1] + (at_mm - line.foot_mm[1]) / (1.0 - height_mm / camera_height_mm(1));
  return second_mm / column_step_mm_ - column;
}

SurfacePoint PlaneRectification::point(int row, double first_column, double second_column, int view) const {
  const PlaneRow& line = rows_[index(row)];
  const double first_arm = first_column * column_step_mm_ - line.foot_mm[0];
  const double second_arm = second_column * column_step_mm_ - line.foot_mm[1];
  const double slope = first_arm / camera_height_mm(0) - second_arm / camera_height_mm(1);
  const double height_mm = (first_column - second_column) * column_step_mm_ / slope;
  // Off the row's plane by nothing; taken on the ray of `view`.
  const double column = view == 0 ? first_column : second_column;
  const Vec2 on_plane = line.origin_mm + column * column_step_mm_ * line.direction;
  const Vec2 camera = camera_mm_[index(view)].head<2>();
  const Vec2 at = camera + (1.0 - height_mm / camera_height_mm(view)) * (on_plane - camera);
  return {static_cast<float>(at.x()), static_cast<float>(at.y()),
          static_cast<float>(plane_height_mm_ + height_mm)};
}

}  // namespace traygauge
