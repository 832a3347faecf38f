#include "core/quality/card_silhouette.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace traygauge {
namespace {

// Takes a point further down into a chain that bends to one side only (Andrew's monotone chain); returns its
// new length.
std::size_t extend_chain(std::span<Vec2> chain, std::size_t size, const Vec2& point, double side) {
  while (size >= 2 && side * cross(chain[size - 1] - chain[size - 2], point - chain[size - 1]) <= 0.0) --size;
  chain[size] = point;
  return size + 1;
}

// The convex hull of the label's pixels (their corners), clockwise in the picture; returns the label's area.
double trace_hull(ImageView<const std::uint8_t> labels, const PixelBox& box,
                  CardSilhouetteWorkspace& workspace, std::span<Vec2>& hull) {
  std::size_t left_size = 0;
  std::size_t right_size = 0;
  double area_px = 0.0;
  for (int y = box.top; y < box.bottom; ++y) {
    const std::uint8_t* begin = labels.row(y) + box.left;
    const std::uint8_t* end = labels.row(y) + box.right;
    const std::uint8_t* first = std::find(begin, end, kCardLabel);
    if (first == end) continue;
    const std::uint8_t* last = end - 1;
    while (*last != kCardLabel) --last;
    area_px += static_cast<double>(std::count(first, last + 1, kCardLabel));
    const double left = box.left + static_cast<double>(first - begin) - 0.5;
    const double right = box.left + static_cast<double>(last - begin) + 0.5;
    for (const double edge : {y - 0.5, y + 0.5}) {
      left_size = extend_chain(workspace.left, left_size, {left, edge}, -1.0);
      right_size = extend_chain(workspace.right, right_size, {right, edge}, 1.0);
    }
  }
  // Down the right side and up the left one.
  std::reverse_copy(workspace.left.begin(), workspace.left.begin() + static_cast<std::ptrdiff_t>(left_size),
                    workspace.right.begin() + static_cast<std::ptrdiff_t>(right_size));
  hull = workspace.right.first(right_size + left_size);
  return area_px;
}

// Where the neighbours of a side meet when they are prolonged beyond it; false when they part.
bool meet_beyond(const Vec2& before, const Vec2& start, const Vec2& end, const Vec2& after, Vec2& meeting) {
  const Vec2 incoming = start - before;
  const Vec2 outgoing = after - end;
  const double turn = cross(incoming, outgoing);
  if (!(turn > 1e-9 * incoming.norm() * outgoing.norm())) return false;
  const double t = cross(end - start, outgoing) / turn;
  meeting = start + t * incoming;
  return t >= 0.0;
}

// Drops the side whose loss enlarges the polygon least, until four are left.
bool reduce_to_quadrilateral(std::span<Vec2>& polygon) {
  while (polygon.size() > 4) {
    const std::size_t size = polygon.size();
    double least_area = 1e12;
    std::size_t least = size;
    Vec2 replacement = Vec2::Zero();
    for (std::size_t i = 0; i < size; ++i) {
      const Vec2& start = polygon[i];
      const Vec2& end = polygon[(i + 1) % size];
      Vec2 meeting;
      if (!meet_beyond(polygon[(i + size - 1) % size], start, end, polygon[(i + 2) % size], meeting))
        continue;
      const double area = 0.5 * std::abs(cross(end - start, meeting - start));
      if (area >= least_area) continue;
      least_area = area;
      least = i;
      replacement = meeting;
    }
    if (least == size) return false;
    polygon[least] = replacement;
    const std::size_t dropped = (least + 1) % size;
    std::copy(polygon.begin() + static_cast<std::ptrdiff_t>(dropped) + 1, polygon.end(),
              polygon.begin() + static_cast<std::ptrdiff_t>(dropped));
    polygon = polygon.first(size - 1);
  }
  return polygon.size() == 4;
}

// The homography of the unit square onto four rays (Heckbert 1989, 2.2.3): its first two columns are the
// rectangle's sides in space, up to a common factor.
bool find_sides(const std::array<Vec2, 4>& rays, Vec3& along, Vec3& across) {
  const Vec2 a = rays[1] - rays[2];
  const Vec2 b = rays[3] - rays[2];
  const Vec2 sum = rays[0] - rays[1] + rays[2] - rays[3];
  const double denominator = cross(a, b);
  if (!(std::abs(denominator) > 0.0)) return false;
  const double g = cross(sum, b) / denominator;
  const double h = cross(a, sum) / denominator;
  along << rays[1] - rays[0] + g * rays[1], g;
  across << rays[3] - rays[0] + h * rays[3], h;
  return along.squaredNorm() > 0.0 && across.squaredNorm() > 0.0;
}

}  // namespace

double CardSilhouette::visible_fraction(double card_aspect_ratio) const {
  if (!is_found) return 0.0;
  const double ratio = aspect_ratio / std::max(card_aspect_ratio, 1.0 / card_aspect_ratio);
  return filled_fraction * std::min(ratio, 1.0 / ratio) * (1.0 - std::abs(skew));
}

CardSilhouette measure_card_silhouette(ImageView<const std::uint8_t> labels, const PixelBox& box,
                                       const LensModel& lens, CardSilhouetteWorkspace& workspace) {
  CardSilhouette outline;
  const auto rows = static_cast<std::size_t>(std::max(box.height(), 0));
  if (box.empty() || 2 * rows > workspace.left.size()) return outline;
  std::span<Vec2> polygon;
  const double area_px = trace_hull(labels, box, workspace, polygon);
  if (!reduce_to_quadrilateral(polygon)) return outline;
  std::array<Vec2, 4> rays;
  for (std::size_t i = 0; i < 4; ++i) {
    outline.corners[i] = {polygon[i].x(), polygon[i].y()};
    if (!lens.undistort_pixel(polygon[i], rays[i])) return outline;
  }
  const double quadrilateral_px = 0.5 * std::abs(cross(polygon[2] - polygon[0], polygon[3] - polygon[1]));
  Vec3 along;
  Vec3 across;
  if (!(quadrilateral_px > 0.0) || !find_sides(rays, along, across)) return outline;
  outline.filled_fraction = std::min(1.0, area_px / quadrilateral_px);
  const double ratio = along.norm() / across.norm();
  outline.aspect_ratio = std::max(ratio, 1.0 / ratio);
  outline.skew = along.dot(across) / (along.norm() * across.norm());
  outline.is_found = true;
  return outline;
}

}  // namespace traygauge
