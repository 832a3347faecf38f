#include "core/surface/view_splat.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/segmentation/label_regions.hpp"

namespace traygauge {
namespace {

using Point = Eigen::Vector3f;

// A sample in cells from the map's first cell; all three axes have the same unit.
struct Corner {
  Point at = Point::Zero();
  std::uint8_t label = 0;
};

constexpr float kEdgeTolerance = 1e-4F;  // barycentric; neighbours share their edges' cells
constexpr std::uint8_t kExtrapolatedWeight = 1;

class ViewSplatter {
 public:
  ViewSplatter(const SurfaceGrid& view, const HeightMapParams& params, HeightMap& map)
      : view_(view),
        cells_(map.cells),
        cell_mm_(static_cast<float>(map.cell_mm)),
        per_mm_(1.0F / cell_mm_),
        origin_mm_(static_cast<float>(map.origin_mm.x()), static_cast<float>(map.origin_mm.y()), 0.0F),
        camera_((view.camera_mm.cast<float>() - origin_mm_) * per_mm_),
        jump_squared_(static_cast<float>(params.jump_cosine * params.jump_cosine)),
        undercut_mm_(static_cast<float>(params.undercut_mm)) {}

  void splat() {
    for (int y = 0; y + 1 < view_.points.height; ++y) {
      for (int x = 0; x + 1 < view_.points.width; ++x) add_quad(x, y);
    }
  }

 private:
  bool corner(int x, int y, Corner& corner) const {
    corner.label = view_.labels.at(x, y);
    if (corner.label == kBackgroundLabel || corner.label == kCardLabel) return false;
    if (view_.evidence.at(x, y) == SurfaceEvidence::none) return false;
    const SurfacePoint& point = view_.points.at(x, y);
    corner.at = (Point(point.x_mm, point.y_mm, point.z_mm) - origin_mm_) * per_mm_;
    return corner.at.allFinite();
  }

  void add_quad(int x, int y) {
    std::array<Corner, 4> c;
    const std::array<bool, 4> known = {corner(x, y, c[0]), corner(x + 1, y, c[1]), corner(x, y + 1, c[2]),
                                       corner(x + 1, y + 1, c[3])};
    const int count = known[0] + known[1] + known[2] + known[3];
    if (count < 3) return;
    if (count == 3) {
      const int missing = !known[0] ? 0 : !known[1] ? 1 : !known[2] ? 2 : 3;
      add_triangle(c[missing == 0 ? 1 : 0], c[missing <= 1 ? 2 : 1], c[missing == 3 ? 2 : 3]);
      return;
    }
    // Cut along the shorter diagonal, so that an occlusion's edge keeps the triangles on its sides whole.
    if ((c[0].at - c[3].at).squaredNorm() <= (c[1].at - c[2].at).squaredNorm()) {
      add_triangle(c[0], c[1], c[3]);
      add_triangle(c[0], c[3], c[2]);
    } else {
      add_triangle(c[0], c[1], c[2]);
      add_triangle(c[1], c[3], c[2]);
    }
  }

  void add_triangle(const Corner& a, const Corner& b, const Corner& c) {
    const Point normal = (b.at - a.at).cross(c.at - a.at);
    const Point sight = camera_ - a.at;
    const float along = normal.dot(sight);
    const float cosine_squared = along * along / (normal.squaredNorm() * sight.squaredNorm() + 1e-20F);
    if (cosine_squared < jump_squared_) {
      add_occlusion({a, b, c});
    } else {
      const auto weight = static_cast<std::uint8_t>(std::min(255.0F, 1.0F + 255.0F * cosine_squared));
      rasterise(a, b, c, CellKind::surface, weight);
    }
  }

  // A triangle whose corners lie on two surfaces, or on one that the line of sight grazes.
  void add_occlusion(std::array<Corner, 3> c) {
    std::array<float, 3> range{};
    for (std::size_t i = 0; i < 3; ++i) range[i] = (c[i].at - camera_).norm();
    const auto order = [&](std::size_t i, std::size_t j) {
      if (range[j] < range[i]) {
        std::swap(range[i], range[j]);
        std::swap(c[i], c[j]);
      }
    };
    order(0, 1);
    order(1, 2);
    order(0, 1);
    const bool one_near = range[1] - range[0] > range[2] - range[1];
    const Corner& alone = one_near ? c[0] : c[2];
    const Corner& left = one_near ? c[1] : c[0];
    const Corner& right = one_near ? c[2] : c[1];
    const auto [left_alone, left_pair] = halfway(alone, left);
    const auto [right_alone, right_pair] = halfway(alone, right);
    rasterise(alone, left_alone, right_alone, CellKind::surface, kExtrapolatedWeight);
    rasterise(left, right, right_pair, CellKind::surface, kExtrapolatedWeight);
    rasterise(left, right_pair, left_pair, CellKind::surface, kExtrapolatedWeight);
    // The sheet's label is what hides: the near side's.
    Corner l0 = left_alone;
    Corner l1 = left_pair;
    Corner r0 = right_alone;
    Corner r1 = right_pair;
    l0.label = l1.label = r0.label = r1.label = c[0].label;
    rasterise(l0, l1, r1, CellKind::hidden, 0);
    rasterise(l0, r1, r0, CellKind::hidden, 0);
  }

  // Both surfaces' ends on the line of sight halfway between two samples.
  std::pair<Corner, Corner> halfway(const Corner& a, const Corner& b) const {
    const Point to_a = a.at - camera_;
    const Point to_b = b.at - camera_;
    const float range_a = to_a.norm();
    const float range_b = to_b.norm();
    const Point middle = (to_a / range_a + to_b / range_b).normalized();
    return {{camera_ + range_a * middle, a.label}, {camera_ + range_b * middle, b.label}};
  }

  void rasterise(const Corner& a, const Corner& b, const Corner& c, CellKind kind, std::uint8_t weight) {
    const float left = std::ceil(std::min({a.at.x(), b.at.x(), c.at.x()}) - kEdgeTolerance);
    const float right = std::floor(std::max({a.at.x(), b.at.x(), c.at.x()}) + kEdgeTolerance);
    if (left > right) return;
    const float top = std::ceil(std::min({a.at.y(), b.at.y(), c.at.y()}) - kEdgeTolerance);
    const float bottom = std::floor(std::max({a.at.y(), b.at.y(), c.at.y()}) + kEdgeTolerance);
    if (top > bottom) return;
    const float x1 = b.at.x() - a.at.x();
    const float y1 = b.at.y() - a.at.y();
    const float x2 = c.at.x() - a.at.x();
    const float y2 = c.at.y() - a.at.y();
    const float area = x1 * y2 - x2 * y1;
    if (!(std::abs(area) > 1e-9F)) return;
    const float per_area = 1.0F / area;
    const int x_begin = static_cast<int>(std::max(left, 0.0F));
    const int x_end = static_cast<int>(std::min(right, static_cast<float>(cells_.width - 1)));
    const int y_begin = static_cast<int>(std::max(top, 0.0F));
    const int y_end = static_cast<int>(std::min(bottom, static_cast<float>(cells_.height - 1)));
    for (int y = y_begin; y <= y_end; ++y) {
      for (int x = x_begin; x <= x_end; ++x) {
        const float u = static_cast<float>(x) - a.at.x();
        const float v = static_cast<float>(y) - a.at.y();
        const float wb = (u * y2 - x2 * v) * per_area;
        const float wc = (x1 * v - u * y1) * per_area;
        const float wa = 1.0F - wb - wc;
        if (wa < -kEdgeTolerance || wb < -kEdgeTolerance || wc < -kEdgeTolerance) continue;
        const float z_mm = (wa * a.at.z() + wb * b.at.z() + wc * c.at.z()) * cell_mm_;
        const std::uint8_t label = wa >= wb && wa >= wc ? a.label : wb >= wc ? b.label : c.label;
        add_patch(cells_.at(x, y), {z_mm, label, kind, weight, false});
      }
    }
  }

  // The uppermost patch over a cell stays.
  void add_patch(HeightCell& cell, HeightCell patch) const {
    if (cell.kind == CellKind::unseen) {
      cell = patch;
      return;
    }
    const bool above = patch.z_mm > cell.z_mm;
    const HeightCell& upper = above ? patch : cell;
    const HeightCell& lower = above ? cell : patch;
    const bool undercut = cell.undercut || (upper.kind == CellKind::surface && is_item(upper.label) &&
                                            lower.kind == CellKind::surface && lower.label != upper.label &&
                                            upper.z_mm - lower.z_mm > undercut_mm_);
    if (above) cell = patch;
    cell.undercut = undercut;
  }

  const SurfaceGrid& view_;
  ImageView<HeightCell> cells_;
  float cell_mm_;
  float per_mm_;
  Point origin_mm_;
  Point camera_;
  float jump_squared_;
  float undercut_mm_;
};

}  // namespace

void splat_view(const SurfaceGrid& view, const HeightMapParams& params, HeightMap& map) {
  for (int y = 0; y < map.cells.height; ++y) {
    std::fill_n(map.cells.row(y), map.cells.width, HeightCell{});
  }
  ViewSplatter(view, params, map).splat();
}

void add_visible_flanks(const SurfaceGrid& view, const HeightMapParams& params, std::span<FlankArea> flanks) {
  const int reach = std::max(1, params.flank_baseline_samples);
  const int step = 2;  // the baselines overlap anyway
  const auto at = [&](int x, int y) {
    const SurfacePoint& point = view.points.at(x, y);
    return Point(point.x_mm, point.y_mm, point.z_mm);
  };
  const Point camera = view.camera_mm.cast<float>();
  // The baselines' cross product spans (2 reach)² samples; every step² of them count once.
  const float share = static_cast<float>(step * step) / static_cast<float>(4 * reach * reach);
  for (int y = reach; y + reach < view.points.height; y += step) {
    for (int x = reach; x + reach < view.points.width; x += step) {
      const std::uint8_t label = view.labels.at(x, y);
      if (!is_item(label)) continue;
      const auto same = [&](int u, int v) {
        return view.labels.at(u, v) == label && view.evidence.at(u, v) != SurfaceEvidence::none;
      };
      if (!same(x - reach, y) || !same(x + reach, y) || !same(x, y - reach) || !same(x, y + reach)) continue;
      Point normal = (at(x + reach, y) - at(x - reach, y)).cross(at(x, y + reach) - at(x, y - reach));
      const Point sight = camera - at(x, y);
      const float along = normal.dot(sight);
      if (along < 0.0F) normal = -normal;
      const float squared = normal.squaredNorm();
      const float sight_squared = sight.squaredNorm();
      const float jump = static_cast<float>(params.jump_cosine);
      if (!(along * along > jump * jump * squared * sight_squared)) continue;
      const float horizontal = std::max(normal.z(), 0.0F);
      if (horizontal * horizontal * sight_squared > squared * (sight_squared - sight.z() * sight.z()))
        continue;
      flanks[label].horizontal_mm2 += static_cast<double>(share * horizontal);
      flanks[label].vertical_mm2 += static_cast<double>(share * std::sqrt(normal.head<2>().squaredNorm()));
    }
  }
}

}  // namespace traygauge
