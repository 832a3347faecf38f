#include "core/paper/surface/food_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/labels/label_regions.hpp"
#include "core/paper/surface/food_grid.hpp"

namespace traygauge::paper {
namespace {

constexpr std::int32_t kNoPoint = -1;

// Counts every label's pixels and bounds the items'.
PixelBox measure_food(ImageView<const std::uint8_t> labels, std::span<MeshCoverage> coverage,
                      std::uint32_t& food_pixels) {
  PixelBox box{labels.width, labels.height, 0, 0};
  food_pixels = 0;
  for (int y = 0; y < labels.height; ++y) {
    const std::uint8_t* row = labels.row(y);
    for (int x = 0; x < labels.width; ++x) {
      if (!is_item(row[x])) continue;
      ++coverage[row[x]].label_px;
      ++food_pixels;
      box.left = std::min(box.left, x);
      box.right = std::max(box.right, x + 1);
      box.top = std::min(box.top, y);
      box.bottom = y + 1;
    }
  }
  return box;
}

// The depth of grid points, measured or bridged.
class DepthSampler {
 public:
  DepthSampler(ImageView<const float> depth_mm, ImageView<const std::uint8_t> labels, const FoodGrid& grid,
               int max_gap_cells)
      : depth_mm_(depth_mm), labels_(labels), grid_(grid), max_gap_cells_(max_gap_cells) {}

  // NaN where unknown.
  double sample(int x, int y) const {
    const double depth = depth_mm_.at(x, y);
    return depth > 0.0 ? depth : std::numeric_limits<double>::quiet_NaN();
  }

  // Interpolates a grid point between the nearest known points of its label along its row and its column,
  // the narrower gap counting more. Inverse depth is linear over a plane in the picture. NaN where neither
  // line has known points on both sides: nothing is extrapolated.
  double bridge(std::size_t column, std::size_t row) const {
    double weighted = 0.0;
    double total = 0.0;
    const auto add_line = [&](const Known& before, const Known& after) {
      if (before.distance_px == 0 || after.distance_px == 0) return;
      const double gap = before.distance_px + after.distance_px;
      const double inverse =
          (before.inverse_depth * after.distance_px + after.inverse_depth * before.distance_px) / gap;
      weighted += inverse / gap;
      total += 1.0 / gap;
    };
    add_line(walk(column, row, -1, 0), walk(column, row, 1, 0));
    add_line(walk(column, row, 0, -1), walk(column, row, 0, 1));
    return total > 0.0 ? total / weighted : std::numeric_limits<double>::quiet_NaN();
  }

 private:
  struct Known {
    int distance_px = 0;  // 0: none found
    double inverse_depth = 0.0;
  };

  Known walk(std::size_t column, std::size_t row, int step_x, int step_y) const {
    const int start_x = grid_.columns[column];
    const int start_y = grid_.rows[row];
    const std::uint8_t label = labels_.at(start_x, start_y);
    for (std::ptrdiff_t k = 1; k <= max_gap_cells_; ++k) {
      const std::ptrdiff_t i = static_cast<std::ptrdiff_t>(column) + k * step_x;
      const std::ptrdiff_t j = static_cast<std::ptrdiff_t>(row) + k * step_y;
      if (i < 0 || j < 0 || i >= std::ssize(grid_.columns) || j >= std::ssize(grid_.rows)) break;
      const int x = grid_.columns[static_cast<std::size_t>(i)];
      const int y = grid_.rows[static_cast<std::size_t>(j)];
      if (labels_.at(x, y) != label) break;
      const double depth = sample(x, y);
      if (!std::isnan(depth)) return {std::abs(x - start_x) + std::abs(y - start_y), 1.0 / depth};
    }
    return {};
  }

  ImageView<const float> depth_mm_;
  ImageView<const std::uint8_t> labels_;
  FoodGrid grid_;
  int max_gap_cells_;
};

// Triangles of one cell. Corners: a b / c d as they lie in the picture.
class CellTriangulator {
 public:
  explicit CellTriangulator(FoodMeshWorkspace& workspace) : workspace_(workspace) {}

  void add_cell(const std::array<std::int32_t, 4>& corners, bool falling_diagonal, double cell_px) {
    const auto [a, b, c, d] = corners;
    half_cell_px_ = 0.5 * cell_px;
    if (falling_diagonal) {
      const bool upper = add_triangle(a, b, d);
      const bool lower = add_triangle(a, d, c);
      if (upper || lower) return;
      if (!add_triangle(a, b, c)) add_triangle(b, d, c);
    } else {
      const bool upper = add_triangle(a, b, c);
      const bool lower = add_triangle(b, d, c);
      if (upper || lower) return;
      if (!add_triangle(a, b, d)) add_triangle(a, d, c);
    }
  }

 private:
  bool add_triangle(std::int32_t i, std::int32_t j, std::int32_t k) {
    if (i == kNoPoint || j == kNoPoint || k == kNoPoint) return false;
    const auto label = [&](std::int32_t p) { return workspace_.points[static_cast<std::size_t>(p)].label; };
    if (label(i) != label(j) || label(i) != label(k)) return false;
    workspace_.coverage[label(i)].covered_px += half_cell_px_;
    return workspace_.triangles.push_back({{i, j, k}, label(i)});
  }

  FoodMeshWorkspace& workspace_;
  double half_cell_px_ = 0.0;
};

// Unprojects the grid points of one row into the workspace; `indices` gets their places. Returns how many
// were bridged.
int add_row(std::size_t row, ImageView<const std::uint8_t> labels, const PinholeCamera& camera,
            const FoodGrid& grid, const DepthSampler& sampler, BoundedList<MeshPoint>& points,
            std::span<std::int32_t> indices) {
  int bridged = 0;
  const int y = grid.rows[row];
  for (std::size_t column = 0; column < grid.columns.size(); ++column) {
    indices[column] = kNoPoint;
    const int x = grid.columns[column];
    const std::uint8_t label = labels.at(x, y);
    if (!is_item(label)) continue;
    double depth = sampler.sample(x, y);
    const bool is_gap = std::isnan(depth);
    if (is_gap) depth = sampler.bridge(column, row);
    if (std::isnan(depth)) continue;
    const Vec2 ray = camera.ray(Vec2(x, y));
    if (!points.push_back({Vec3(ray.x(), ray.y(), 1.0) * depth, label})) continue;
    indices[column] = static_cast<std::int32_t>(points.size()) - 1;
    bridged += is_gap ? 1 : 0;
  }
  return bridged;
}

}  // namespace

Status build_food_mesh(ImageView<const float> depth_mm, ImageView<const std::uint8_t> labels,
                       const PinholeCamera& camera, const FoodMeshParams& params,
                       FoodMeshWorkspace& workspace, FoodMesh& mesh) {
  mesh = {};
  workspace.points.clear();
  workspace.triangles.clear();
  std::fill(workspace.coverage.begin(), workspace.coverage.end(), MeshCoverage{});
  if (static_cast<std::size_t>(labels.width) > workspace.columns.size() ||
      static_cast<std::size_t>(labels.height) > workspace.rows.size()) {
    return StatusCode::out_of_memory;
  }
  if (depth_mm.width != labels.width || depth_mm.height != labels.height) {
    return StatusCode::labels_size_mismatch;
  }
  std::uint32_t food_pixels = 0;
  const PixelBox food = measure_food(labels, workspace.coverage, food_pixels);
  if (food_pixels == 0) return StatusCode::no_food_label;

  const int max_points = std::min(params.points, static_cast<int>(workspace.points.capacity()));
  const FoodGrid grid =
      fit_food_grid(labels, food, food_pixels, max_points, workspace.columns, workspace.rows);
  const DepthSampler sampler(depth_mm, labels, grid, params.max_gap_cells);
  CellTriangulator triangulator(workspace);
  std::span<std::int32_t> upper = workspace.upper;
  std::span<std::int32_t> lower = workspace.lower;
  for (std::size_t row = 0; row < grid.rows.size(); ++row) {
    mesh.bridged_points += add_row(row, labels, camera, grid, sampler, workspace.points, lower);
    for (std::size_t column = 1; row > 0 && column < grid.columns.size(); ++column) {
      const double cell_px = static_cast<double>(grid.columns[column] - grid.columns[column - 1]) *
                             (grid.rows[row] - grid.rows[row - 1]);
      triangulator.add_cell({upper[column - 1], upper[column], lower[column - 1], lower[column]},
                            (row + column) % 2 == 0, cell_px);
    }
    std::swap(upper, lower);
  }
  mesh.points = workspace.points.items();
  mesh.triangles = workspace.triangles.items();
  mesh.coverage = workspace.coverage;
  mesh.spacing_px = grid.spacing_px;
  mesh.grid_points = grid.food_points;
  return mesh.triangles.empty() ? StatusCode::too_little_depth : StatusCode::ok;
}

}  // namespace traygauge::paper
