#include "core/card/card_outline.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/base/bounded_list.hpp"

namespace traygauge {
namespace {

constexpr int kSupportBins = std::numeric_limits<std::uint32_t>::digits;  // along a side: the bits of a word

struct Line {
  Vec2 point = Vec2::Zero();
  Vec2 direction = Vec2::UnitX();  // of unit length
};

bool intersect(const Line& a, const Line& b, Vec2& point) {
  const double sine = cross(a.direction, b.direction);
  if (!(std::abs(sine) > 1e-3)) return false;
  point = a.point + cross(b.point - a.point, b.direction) / sine * a.direction;
  return point.allFinite();
}

Line line_through(const Vec2& a, const Vec2& b) {
  return {a, (b - a).normalized()};
}

// Collects where the label begins and ends in rows and columns, half a pixel outside the outermost pixels.
class OutlinePoints {
 public:
  OutlinePoints(ImageView<const std::uint8_t> labels, const PixelBox& box, const LensModel& lens,
                std::span<Vec2> storage)
      : labels_(labels), box_(box), lens_(lens), points_(storage) {
    const auto lines = static_cast<std::size_t>(box.width()) + static_cast<std::size_t>(box.height());
    step_ = static_cast<int>(2 * lines / std::max<std::size_t>(1, storage.size())) + 1;
  }

  std::span<const Vec2> collect() {
    for (int y = box_.top; y < box_.bottom; y += step_) add_row(y);
    for (int x = box_.left; x < box_.right; x += step_) add_column(x);
    return points_.items();
  }

 private:
  void add(double x, double y) {
    Vec2 ray;
    if (lens_.undistort_pixel({x, y}, ray)) points_.push_back(ray);
  }
  void add_row(int y) {
    int left = box_.left;
    int right = box_.right - 1;
    while (left <= right && labels_.at(left, y) != kCardLabel) ++left;
    while (right > left && labels_.at(right, y) != kCardLabel) --right;
    if (left > right) return;
    add(left - 0.5, y);
    add(right + 0.5, y);
  }
  void add_column(int x) {
    int top = box_.top;
    int bottom = box_.bottom - 1;
    while (top <= bottom && labels_.at(x, top) != kCardLabel) ++top;
    while (bottom > top && labels_.at(x, bottom) != kCardLabel) --bottom;
    if (top > bottom) return;
    add(x, top - 0.5);
    add(x, bottom + 0.5);
  }

  ImageView<const std::uint8_t> labels_;
  PixelBox box_;
  const LensModel& lens_;
  BoundedList<Vec2> points_;
  int step_ = 1;
};

// Andrew's monotone chain; `sorted` is reordered. Clockwise in the picture (y down).
std::span<Vec2> convex_hull(std::span<Vec2> sorted, std::span<Vec2> hull) {
  std::sort(sorted.begin(), sorted.end(),
            [](const Vec2& a, const Vec2& b) { return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y(); });
  std::size_t size = 0;
  const auto add = [&](const Vec2& point, std::size_t first) {
    while (size >= first + 2 && cross(hull[size - 1] - hull[size - 2], point - hull[size - 1]) <= 0.0) --size;
    hull[size++] = point;
  };
  for (const Vec2& point : sorted) add(point, 0);
  const std::size_t lower = size - 1;
  for (std::size_t i = sorted.size() - 1; i-- > 0;) add(sorted[i], lower);
  return hull.first(size - 1);
}

// Replaces the hull's side that is cheapest to remove by the crossing of its neighbours; false when none can
// be.
bool remove_cheapest_side(std::span<Vec2> hull) {
  const std::size_t count = hull.size();
  if (count == 0) return false;
  double least = std::numeric_limits<double>::infinity();
  std::size_t cheapest = 0;
  Vec2 bundle = Vec2::Zero();
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2& before = hull[(i + count - 1) % count];
    const Vec2& begin = hull[i];
    const Vec2& end = hull[(i + 1) % count];
    const Vec2& after = hull[(i + 2) % count];
    Vec2 crossing;
    if (!(cross(begin - before, after - end) > 0.0)) continue;  // the neighbours diverge
    if (!intersect(line_through(before, begin), line_through(end, after), crossing)) continue;
    const double added = cross(crossing - begin, end - crossing);
    if (added < -kRounding || added >= least) continue;
    least = std::max(added, 0.0);
    cheapest = i;
    bundle = crossing;
  }
  if (!std::isfinite(least)) return false;
  hull[cheapest] = bundle;
  const std::size_t gone = (cheapest + 1) % count;
  std::move(hull.begin() + static_cast<std::ptrdiff_t>(gone) + 1, hull.end(),
            hull.begin() + static_cast<std::ptrdiff_t>(gone));
  return true;
}

struct SideFit {
  double near = 0.0;  // in rays, as inlier
  double inlier = 0.0;
  double corner_fraction = 0.0;
};

// Total least squares with Cauchy's weights on the points near the side; false when they are too few.
bool fit_side(std::span<const Vec2> points, const Vec2& begin, const Vec2& end, const SideFit& fit,
              Line& line) {
  line = line_through(begin, end);
  const double length = (end - begin).norm();
  for (int round = 0; round < kSettlingRounds; ++round) {
    const Vec2 normal(-line.direction.y(), line.direction.x());
    double weights = 0.0;
    Vec2 sum = Vec2::Zero();
    Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
    int count = 0;
    for (const Vec2& point : points) {
      const Vec2 offset = point - begin;
      const double along = line.direction.dot(offset);
      const double away = normal.dot(point - line.point);
      if (along < fit.corner_fraction * length || along > (1.0 - fit.corner_fraction) * length) continue;
      if (std::abs(away) > fit.near) continue;
      const double weight = 1.0 / (1.0 + away * away / (fit.inlier * fit.inlier));
      weights += weight;
      sum += weight * offset;
      scatter += weight * offset * offset.transpose();
      ++count;
    }
    if (count < 4) return false;
    const Vec2 mean = sum / weights;
    scatter = scatter / weights - mean * mean.transpose();
    // The direction of the largest extent turned by the least angle from the present one.
    const double along = line.direction.dot(scatter * line.direction);
    const double mixed = normal.dot(scatter * line.direction);
    const double across = normal.dot(scatter * normal);
    if (!(along > across)) return false;
    line.direction = (line.direction + mixed / (along - across) * normal).normalized();
    line.point = begin + mean;
  }
  return line.direction.allFinite() && line.point.allFinite();
}

double support_of(std::span<const Vec2> points, const Vec2& begin, const Vec2& end, double inlier) {
  const Line line = line_through(begin, end);
  const double length = (end - begin).norm();
  std::uint32_t seen = 0;
  for (const Vec2& point : points) {
    const Vec2 offset = point - begin;
    const double along = line.direction.dot(offset) / length;
    if (std::abs(cross(line.direction, offset)) > inlier || !(along >= 0.0) || along >= 1.0) continue;
    seen |= 1U << static_cast<unsigned>(along * kSupportBins);
  }
  return static_cast<double>(std::popcount(seen)) / kSupportBins;
}

bool is_convex(const std::array<Vec2, 4>& corners) {
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec2 side = corners[(i + 1) % 4] - corners[i];
    const Vec2 next = corners[(i + 2) % 4] - corners[(i + 1) % 4];
    if (!(cross(side, next) > 0.0)) return false;
  }
  return true;
}

}  // namespace

Result<CardOutline> find_card_outline(ImageView<const std::uint8_t> labels, const PixelBox& box,
                                      const LensModel& lens, const CardOutlineParams& params,
                                      CardOutlineWorkspace& workspace) {
  if (box.empty() || std::max(box.width(), box.height()) < params.min_side_px)
    return StatusCode::card_not_found;
  const auto points = OutlinePoints(labels, box, lens, workspace.points).collect();
  if (points.size() < 8) return StatusCode::card_not_found;
  std::copy(points.begin(), points.end(), workspace.sorted.begin());
  std::span<Vec2> hull = convex_hull(workspace.sorted.first(points.size()), workspace.hull);
  while (hull.size() > 4) {
    if (!remove_cheapest_side(hull)) return StatusCode::card_not_found;
    hull = hull.first(hull.size() - 1);
  }
  if (hull.size() < 4) return StatusCode::card_not_found;
  const double px = 1.0 / lens.pinhole.mean_focal_px();
  const SideFit fit{params.near_px * px, params.inlier_px * px, params.corner_fraction};
  std::array<Line, 4> sides;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec2& end = hull[(i + 1) % 4];
    if (!fit_side(points, hull[i], end, fit, sides[i])) sides[i] = line_through(hull[i], end);
  }
  CardOutline outline;
  for (std::size_t i = 0; i < 4; ++i) {
    if (!intersect(sides[(i + 3) % 4], sides[i], outline.corners[i])) return StatusCode::card_not_found;
  }
  if (!is_convex(outline.corners)) return StatusCode::card_not_found;
  for (std::size_t i = 0; i < 4; ++i) {
    const double wide = 2.0 * params.inlier_px * px;
    outline.support[i] = support_of(points, outline.corners[i], outline.corners[(i + 1) % 4], wide);
  }
  return outline;
}

}  // namespace traygauge
