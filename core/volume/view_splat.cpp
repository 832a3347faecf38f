#include "core/volume/view_splat.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/labels/label_regions.hpp"

namespace traygauge {
namespace {

using Point = Eigen::Vector3f;

using SurfaceCorner = HeightMapWorkspace::Corner;

Point at(const SurfaceCorner& corner) {
  return {corner.x, corner.y, corner.z};
}

SurfaceCorner corner_at(const Point& place, std::uint8_t label) {
  return {place.x(), place.y(), place.z(), label, true};
}

constexpr float kEdgeTolerance = 1e-4F;  // barycentric; neighbours share their edges' cells

class ViewSplatter {
 public:
  ViewSplatter(const SurfaceGrid& view, const HeightMapParams& params, std::span<SurfaceCorner> corners,
               HeightMap& map)
      : view_(view),
        corners_(corners),
        cells_(map.cells),
        cell_mm_(static_cast<float>(map.cell_mm)),
        per_mm_(1.0F / cell_mm_),
        origin_mm_(static_cast<float>(map.origin_mm.x()), static_cast<float>(map.origin_mm.y()), 0.0F),
        camera_((view.camera_mm.cast<float>() - origin_mm_) * per_mm_),
        jump_squared_(static_cast<float>(params.jump_cosine * params.jump_cosine)),
        undercut_mm_(static_cast<float>(params.undercut_mm)) {}

  void splat() {
    load_row(0);
    for (int y = 0; y + 1 < view_.points.height; y += 2) {
      load_row(y + 1);
      if (y + 2 < view_.points.height) load_row(y + 2);
      for (int x = 0; x + 1 < view_.points.width; x += 2) add_block(x, y);
    }
  }

 private:
  SurfaceCorner* row(int y) const {
    return corners_.data() + static_cast<std::ptrdiff_t>(y % 3) * view_.points.width;
  }

  void load_row(int y) {
    SurfaceCorner* corners = row(y);
    const SurfacePoint* points = view_.points.row(y);
    const SurfaceEvidence* evidence = view_.evidence.row(y);
    const std::uint8_t* labels = view_.labels.row(y);
    for (int x = 0; x < view_.points.width; ++x) {
      const bool on_dish = labels[x] != kBackgroundLabel && labels[x] != kCardLabel;
      if (!on_dish || evidence[x] == SurfaceEvidence::none) {
        corners[x].known = false;
        continue;
      }
      const Point place = (Point(points[x].x_mm, points[x].y_mm, points[x].z_mm) - origin_mm_) * per_mm_;
      corners[x] = corner_at(place, labels[x]);
      corners[x].known = place.allFinite();
    }
  }

  // Two by two quads.
  void add_block(int x, int y) {
    const int right = std::min(x + 2, view_.points.width - 1);
    const int bottom = std::min(y + 2, view_.points.height - 1);
    bool bare = true;
    for (int v = y; v <= bottom && bare; ++v) {
      const SurfaceCorner* corners = row(v);
      for (int u = x; u <= right; ++u) bare = bare && corners[u].known && !is_item(corners[u].label);
    }
    if (bare) {
      add_quad(row(y)[x], row(y)[right], row(bottom)[x], row(bottom)[right]);
      return;
    }
    for (int v = y; v < bottom; ++v) {
      const SurfaceCorner* upper = row(v);
      const SurfaceCorner* lower = row(v + 1);
      for (int u = x; u < right; ++u) add_quad(upper[u], upper[u + 1], lower[u], lower[u + 1]);
    }
  }

  void add_quad(const SurfaceCorner& a, const SurfaceCorner& b, const SurfaceCorner& c,
                const SurfaceCorner& d) {
    const auto known = std::ranges::count(std::array{a.known, b.known, c.known, d.known}, true);
    if (known < 3) return;
    if (known == 3) {
      add_triangle(a.known ? a : d, b.known ? b : d, c.known ? c : d);
      return;
    }
    // Cut along the shorter diagonal, so that an occlusion's edge keeps the triangles on its sides whole.
    if ((at(a) - at(d)).squaredNorm() <= (at(b) - at(c)).squaredNorm()) {
      add_triangle(a, b, d);
      add_triangle(a, d, c);
    } else {
      add_triangle(a, b, c);
      add_triangle(b, d, c);
    }
  }

  void add_triangle(const SurfaceCorner& a, const SurfaceCorner& b, const SurfaceCorner& c) {
    const Point normal = (at(b) - at(a)).cross(at(c) - at(a));
    const Point sight = camera_ - at(a);
    const float along = normal.dot(sight);
    const float cosine_squared = along * along / (normal.squaredNorm() * sight.squaredNorm() + 1e-20F);
    if (cosine_squared < jump_squared_) {
      add_occlusion({a, b, c});
    } else {
      const auto weight = static_cast<std::uint8_t>(std::min(255.0F, 2.0F + 253.0F * cosine_squared));
      add_surface(a, b, c, weight);
    }
  }

  // A triangle whose corners lie on two surfaces, or on one that the line of sight grazes.
  void add_occlusion(std::array<SurfaceCorner, 3> c) {
    std::array<float, 3> range{};
    for (std::size_t i = 0; i < 3; ++i) range[i] = (at(c[i]) - camera_).norm();
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
    const SurfaceCorner& alone = one_near ? c[0] : c[2];
    const SurfaceCorner& left = one_near ? c[1] : c[0];
    const SurfaceCorner& right = one_near ? c[2] : c[1];
    const auto [left_alone, left_pair] = halfway(alone, left);
    const auto [right_alone, right_pair] = halfway(alone, right);
    add_surface(alone, left_alone, right_alone, kExtrapolatedWeight);
    add_surface(left, right, right_pair, kExtrapolatedWeight);
    add_surface(left, right_pair, left_pair, kExtrapolatedWeight);
    add_sheet(left_alone, left_pair, right_pair, c[0], c[2]);
    add_sheet(left_alone, right_pair, right_alone, c[0], c[2]);
  }

  // Lines of sight from the edge of what hides to where they end.
  void add_sheet(const SurfaceCorner& a, const SurfaceCorner& b, const SurfaceCorner& c,
                 const SurfaceCorner& edge, const SurfaceCorner& foot) {
    const float below_mm = cell_mm_ * foot.z;
    rasterise(a, b, c, {0.0F, below_mm, edge.label, foot.label, CellKind::hidden});
  }

  void add_surface(const SurfaceCorner& a, const SurfaceCorner& b, const SurfaceCorner& c,
                   std::uint8_t weight) {
    rasterise(a, b, c, {.kind = CellKind::surface, .weight = weight});
  }

  // Both surfaces' ends on the line of sight halfway between two samples.
  std::pair<SurfaceCorner, SurfaceCorner> halfway(const SurfaceCorner& a, const SurfaceCorner& b) const {
    const Point to_a = at(a) - camera_;
    const Point to_b = at(b) - camera_;
    const float range_a = to_a.norm();
    const float range_b = to_b.norm();
    const Point middle = (to_a / range_a + to_b / range_b).normalized();
    return {corner_at(camera_ + range_a * middle, a.label), corner_at(camera_ + range_b * middle, b.label)};
  }

  void rasterise(const SurfaceCorner& a, const SurfaceCorner& b, const SurfaceCorner& c, HeightCell patch) {
    const float left = std::ceil(std::min({a.x, b.x, c.x}) - kEdgeTolerance);
    const float right = std::floor(std::max({a.x, b.x, c.x}) + kEdgeTolerance);
    if (left > right) return;
    const float top = std::ceil(std::min({a.y, b.y, c.y}) - kEdgeTolerance);
    const float bottom = std::floor(std::max({a.y, b.y, c.y}) + kEdgeTolerance);
    if (top > bottom) return;
    const float x1 = b.x - a.x;
    const float y1 = b.y - a.y;
    const float x2 = c.x - a.x;
    const float y2 = c.y - a.y;
    const float area = x1 * y2 - x2 * y1;
    if (!(std::abs(area) > 1e-9F)) return;
    const float per_area = 1.0F / area;
    const int x_begin = static_cast<int>(std::max(left, 0.0F));
    const int x_end = static_cast<int>(std::min(right, static_cast<float>(cells_.width - 1)));
    const int y_begin = static_cast<int>(std::max(top, 0.0F));
    const int y_end = static_cast<int>(std::min(bottom, static_cast<float>(cells_.height - 1)));
    for (int y = y_begin; y <= y_end; ++y) {
      for (int x = x_begin; x <= x_end; ++x) {
        const float u = static_cast<float>(x) - a.x;
        const float v = static_cast<float>(y) - a.y;
        const float wb = (u * y2 - x2 * v) * per_area;
        const float wc = (x1 * v - u * y1) * per_area;
        const float wa = 1.0F - wb - wc;
        if (wa < -kEdgeTolerance || wb < -kEdgeTolerance || wc < -kEdgeTolerance) continue;
        patch.z_mm = (wa * a.z + wb * b.z + wc * c.z) * cell_mm_;
        if (patch.kind == CellKind::surface) {
          patch.label = wa >= wb && wa >= wc ? a.label : wb >= wc ? b.label : c.label;
        }
        add_patch(cells_.at(x, y), patch);
      }
    }
  }

  // The uppermost patch over a cell stays.
  void add_patch(HeightCell& cell, const HeightCell& patch) const {
    if (cell.kind == CellKind::unseen) {
      cell = patch;
      return;
    }
    const bool above = patch.z_mm > cell.z_mm;
    const HeightCell& upper = above ? patch : cell;
    const HeightCell& lower = above ? cell : patch;
    const bool overhangs = upper.kind == CellKind::surface && lower.kind == CellKind::surface &&
                           lower.label != upper.label && upper.z_mm - lower.z_mm > undercut_mm_;
    const std::uint8_t below_label = overhangs ? lower.label : upper.below_label;
    if (above) cell = patch;
    if (cell.kind == CellKind::surface) cell.below_label = below_label;
  }

  const SurfaceGrid& view_;
  std::span<SurfaceCorner> corners_;
  ImageView<HeightCell> cells_;
  float cell_mm_;
  float per_mm_;
  Point origin_mm_;
  Point camera_;
  float jump_squared_;
  float undercut_mm_;
};

}  // namespace

void splat_view(const SurfaceGrid& view, const HeightMapParams& params, std::span<SurfaceCorner> corners,
                HeightMap& map) {
  for (int y = 0; y < map.cells.height; ++y) {
    std::fill_n(map.cells.row(y), map.cells.width, HeightCell{});
  }
  ViewSplatter(view, params, corners, map).splat();
}

}  // namespace traygauge
