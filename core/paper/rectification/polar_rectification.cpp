#include "core/paper/rectification/polar_rectification.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/paper/rectification/line_sampling.hpp"

namespace traygauge::paper {
namespace {

constexpr double kFullTurn = 2.0 * std::numbers::pi;

// A unit vector orthogonal to the unit vector `axis`: what is left of `wish`, or of a coordinate axis.
Vec3 orthogonal_to(const Vec3& axis, const Vec3& wish) {
  constexpr double kUsable = 1e-6;  // of the length of `wish`; any frame will do, so the value is free
  const Vec3 rest = wish - axis * axis.dot(wish);
  if (rest.norm() > kUsable * wish.norm()) return rest.normalized();
  return axis.unitOrthogonal();
}

bool is_valid(const RectificationInput& input) {
  return !input.region.empty() && input.camera.fx_px > 0.0 && input.camera.fy_px > 0.0;
}

}  // namespace

Status validate(const RectificationParams& params) {
  const bool valid = params.max_rows >= 2 && params.max_columns >= 2 && params.max_reduction >= 1.0 &&
                     params.margin_px >= 0.0 && params.min_epipole_distance_px >= 1.0 &&
                     params.order_samples >= 2;
  return valid ? StatusCode::ok : StatusCode::invalid_configuration;
}

Status PolarRectification::build(const RectificationInput& first, const RectificationInput& second,
                                 const Pose& second_from_first, std::span<const RayMatch> inliers,
                                 const RectificationParams& params, RectificationWorkspace& workspace) {
  *this = {};
  const bool built = set_up_geometry(first, second, second_from_first) && find_angle_range(params) &&
                     find_column_range(views_[0], params) && find_column_range(views_[1], params) &&
                     choose_sampling(params) && fill_rows(params, workspace) && fill_lines(workspace);
  if (!built) {
    *this = {};
    return StatusCode::rectification_failed;
  }
  if (is_order_inverted(inliers, workspace)) {
    mirrored_ = true;
    views_[1].mirrored = true;
    if (!fill_lines(workspace)) return StatusCode::rectification_failed;
  }
  return StatusCode::ok;
}

bool PolarRectification::set_up_geometry(const RectificationInput& first, const RectificationInput& second,
                                         const Pose& pose) {
  if (!is_valid(first) || !is_valid(second)) return false;
  const double length = pose.translation.norm();
  if (!(length > 0.0) || !std::isfinite(length) || !pose.rotation.allFinite()) return false;
  const std::array inputs = {&first, &second};
  const Vec3 baseline = -(pose.rotation.transpose() * pose.translation) / length;
  for (std::size_t i = 0; i < views_.size(); ++i) {
    View& view = views_[i];
    view.box = bounding_box(inputs[i]->region);
    if (view.box.isEmpty()) return false;
    view.geometry.camera = inputs[i]->camera;
    view.geometry.anchor_px = view.box.center();
  }
  const Vec2 centre = first.camera.ray(views_[0].geometry.anchor_px);
  const Vec3 zero_angle = orthogonal_to(baseline, Vec3(centre.x(), centre.y(), 1.0));
  const std::array rotations = {Mat3(Mat3::Identity()), pose.rotation};
  for (std::size_t i = 0; i < views_.size(); ++i) {
    EpipolarView& view = views_[i].geometry;
    view.baseline = rotations[i] * baseline;
    view.zero_angle = rotations[i] * zero_angle;
    view.right_angle = view.baseline.cross(view.zero_angle);
    // Closer than a pixel the order of angles around the epipole means nothing.
    views_[i].extent = measure_extent(view, inputs[i]->region, 1.0);
  }
  return true;
}

// The half-planes that cross both dishes.
bool PolarRectification::find_angle_range(const RectificationParams& params) {
  max_spacing_ = 1.0 / params.min_epipole_distance_px;
  const RegionExtent& first = views_[0].extent;
  RegionExtent second = views_[1].extent;
  if (first.surrounds_epipole && second.surrounds_epipole) {
    min_angle_ = -std::numbers::pi;
    max_angle_ = std::numbers::pi;
    return true;
  }
  if (first.surrounds_epipole || second.surrounds_epipole) {
    const RegionExtent& bound = first.surrounds_epipole ? second : first;
    min_angle_ = bound.min_angle;
    max_angle_ = bound.max_angle;
  } else {
    const double apart = first.min_angle + first.max_angle - second.min_angle - second.max_angle;
    const double turns = std::round(0.5 * apart / kFullTurn);
    min_angle_ = std::max(first.min_angle, second.min_angle + turns * kFullTurn);
    max_angle_ = std::min(first.max_angle, second.max_angle + turns * kFullTurn);
  }
  if (!(min_angle_ < max_angle_)) return false;
  const double before = params.margin_px * row_spacing(min_angle_);
  const double after = params.margin_px * row_spacing(max_angle_);
  const double excess = std::max(0.0, max_angle_ - min_angle_ + before + after - kFullTurn);
  min_angle_ -= before - 0.5 * excess;
  max_angle_ += after - 0.5 * excess;
  return true;
}

// From the dish pixel nearest to the baseline's direction to the farthest, less what is near the epipole.
bool PolarRectification::find_column_range(View& view, const RectificationParams& params) {
  const double epipole_depth = view.geometry.epipole().z();
  view.first_along = view.extent.min_along - params.margin_px;
  view.last_along = view.extent.max_along + params.margin_px;
  const double mask = view.geometry.distance_along_at(params.min_epipole_distance_px);
  if (epipole_depth > 0.0) view.first_along = std::max(view.first_along, mask);
  if (epipole_depth < 0.0) view.last_along = std::min(view.last_along, mask);
  return view.first_along < view.last_along;
}

// The angle to the next row at which no dish pixel of either view is compressed ([31] section 3.3); taken at
// the outermost corner of the box, so that it also holds a little beside the row. Where the dish lies on the
// other side of the epipole, the masked pixels set the step.
double PolarRectification::row_spacing(double angle) const {
  return std::min({views_[0].geometry.angle_per_pixel(angle, views_[0].box),
                   views_[1].geometry.angle_per_pixel(angle, views_[1].box), max_spacing_});
}

// Rows `pixels` apart that cover the range of angles; max_rows + 1 when those do not suffice.
int PolarRectification::count_rows(double pixels, int max_rows) const {
  double angle = min_angle_;
  int rows = 1;
  for (; angle < max_angle_ && rows <= max_rows; ++rows) angle += pixels * row_spacing(angle);
  return rows;
}

// One reduction for rows and columns of both views brings them within the caps.
bool PolarRectification::choose_sampling(const RectificationParams& params) {
  constexpr double kRoom = 1.01;  // the spacing varies from row to row: a reduced count may be off by a few
  const int most_rows = static_cast<int>(params.max_reduction * params.max_rows);
  const int rows = count_rows(1.0, most_rows);
  double columns = 0.0;
  for (const View& view : views_) columns = std::max(columns, view.last_along - view.first_along + 2.0);
  const double reduction =
      std::max(static_cast<double>(rows) / params.max_rows, columns / params.max_columns);
  pixels_per_sample_ = reduction > 1.0 ? kRoom * reduction : 1.0;
  for (View& view : views_) {
    view.columns = static_cast<int>(std::ceil((view.last_along - view.first_along) / pixels_per_sample_)) + 1;
  }
  return pixels_per_sample_ <= params.max_reduction;
}

bool PolarRectification::fill_rows(const RectificationParams& params, RectificationWorkspace& workspace) {
  const int rows = count_rows(pixels_per_sample_, params.max_rows);
  if (rows < 2 || rows > params.max_rows || index(rows) > workspace.angles.size()) return false;
  angles_ = workspace.angles.first(index(rows));
  double angle = min_angle_;
  for (double& entry : angles_) {
    entry = angle;
    angle += pixels_per_sample_ * row_spacing(angle);
  }
  // Shrunk by less than a row so that the last one ends the range: a full turn closes on its first row.
  const double shrink = (max_angle_ - min_angle_) / (angles_.back() - min_angle_);
  for (double& entry : angles_) entry = min_angle_ + shrink * (entry - min_angle_);
  return true;
}

bool PolarRectification::line_at(const View& view, double angle, RectifiedLine& line) const {
  const bool visible = view.geometry.half_line(angle, view.first_along, line);
  line.step *= pixels_per_sample_;
  if (view.mirrored) {
    line.origin = line.pixel(view.columns - 1);
    line.step = -line.step;
  }
  return visible;
}

bool PolarRectification::fill_lines(RectificationWorkspace& workspace) {
  for (std::size_t i = 0; i < views_.size(); ++i) {
    View& view = views_[i];
    view.lines = workspace.lines[i].first(angles_.size());
    for (std::size_t row = 0; row < angles_.size(); ++row) {
      if (!line_at(view, angles_[row], view.lines[row])) return false;
    }
  }
  return true;
}

// Whether most pairs of matches change their horizontal order from view to view (paper III-B-1).
bool PolarRectification::is_order_inverted(std::span<const RayMatch> inliers,
                                           RectificationWorkspace& workspace) const {
  auto& [first, second] = workspace.sampled_columns;
  const std::size_t stride = (inliers.size() + first.size() - 1) / first.size();
  std::size_t count = 0;
  for (std::size_t i = 0; i < inliers.size(); i += stride) {
    Vec2 in_first;
    Vec2 in_second;
    if (!rectified(0, views_[0].geometry.camera.pixel(inliers[i].first), in_first)) continue;
    if (!rectified(1, views_[1].geometry.camera.pixel(inliers[i].second), in_second)) continue;
    first[count] = in_first.x();
    second[count] = in_second.x();
    ++count;
  }
  std::size_t inverted = 0;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      inverted += (first[i] - first[j]) * (second[i] - second[j]) < 0.0 ? 1U : 0U;
    }
  }
  return 4 * inverted > count * (count - (count > 0 ? 1U : 0U));
}

Vec2 PolarRectification::pixel(int view, double column, double row) const {
  const double last = rows() - 2.0;
  const double above = std::clamp(std::floor(row), 0.0, last);
  const auto i = static_cast<std::size_t>(above);
  const double angle = angles_[i] + (row - above) * (angles_[i + 1] - angles_[i]);
  RectifiedLine at_row;
  line_at(views_[index(view)], angle, at_row);
  return at_row.pixel(column);
}

bool PolarRectification::rectified(int view, const Vec2& pixel, Vec2& column_row) const {
  const View& from = views_[index(view)];
  double angle = from.geometry.angle(pixel);
  angle -= kFullTurn * std::floor((angle - angles_.front()) / kFullTurn);
  if (!(angle <= angles_.back())) return false;
  const auto next = std::upper_bound(angles_.begin() + 1, angles_.end() - 1, angle);
  const double above = *(next - 1);
  column_row.y() = static_cast<double>(next - 1 - angles_.begin()) + (angle - above) / (*next - above);
  const double along = (from.geometry.distance_along(pixel) - from.first_along) / pixels_per_sample_;
  column_row.x() = from.mirrored ? from.columns - 1 - along : along;
  return along >= 0.0 && along <= from.columns - 1;
}

void PolarRectification::rectify(int view, ImageView<const std::uint8_t> source,
                                 ImageView<std::uint8_t> target) const {
  for (int row = 0; row < rows(); ++row) {
    sample_line_bilinear(source, line(view, row), {target.row(row), index(columns(view))});
  }
}

void PolarRectification::rectify_labels(int view, ImageView<const std::uint8_t> source,
                                        ImageView<std::uint8_t> target) const {
  for (int row = 0; row < rows(); ++row) {
    sample_line_nearest(source, line(view, row), {target.row(row), index(columns(view))});
  }
}

}  // namespace traygauge::paper
