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
      const auto weight = static_cast<std::uint8_t>(std::min(255.0F, 2.0F + 253.0F * cosine_squared));
      add_surface(a, b, c, weight);
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
    add_surface(alone, left_alone, right_alone, kExtrapolatedWeight);
    add_surface(left, right, right_pair, kExtrapolatedWeight);
    add_surface(left, right_pair, left_pair, kExtrapolatedWeight);
    add_sheet(left_alone, left_pair, right_pair, c[0], c[2]);
    add_sheet(left_alone, right_pair, right_alone, c[0], c[2]);
  }

  // Lines of sight from the edge of what hides to where they end.
  void add_sheet(const Corner& a, const Corner& b, const Corner& c, const Corner& edge, const Corner& foot) {
    const float below_mm = cell_mm_ * foot.at.z();
    rasterise(a, b, c, {0.0F, below_mm, edge.label, foot.label, CellKind::hidden});
  }

  void add_surface(const Corner& a, const Corner& b, const Corner& c, std::uint8_t weight) {
    rasterise(a, b, c, {.kind = CellKind::surface, .weight = weight});
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

  void rasterise(const Corner& a, const Corner& b, const Corner& c, HeightCell patch) {
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
        patch.z_mm = (wa * a.at.z() + wb * b.at.z() + wc * c.at.z()) * cell_mm_;
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

}  // namespace traygauge
