// The food surface: a fixed number of grid points, triangulated in the picture (paper III-C-1).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/arena.hpp"
#include "core/base/bounded_list.hpp"
#include "core/base/status.hpp"
#include "core/geometry/camera.hpp"
#include "core/geometry/geometry.hpp"
#include "core/image_view/image_view.hpp"

namespace traygauge::paper {

struct FoodMeshParams {
  int points = 4096;  // 2^12 (paper, Table IV)
  // Widest row of grid points without depth that is bridged between known points of the same label; a
  // Delaunay triangulation of the known points has no limit. 0 leaves every gap open.
  int max_gap_cells = 1000;
};

struct MeshPoint {
  Vec3 position_mm = Vec3::Zero();  // in the first camera
  std::uint8_t label = 0;
};

// Corners run clockwise in the picture.
struct MeshTriangle {
  std::array<std::int32_t, 3> corners{};
  std::uint8_t label = 0;
};

// How much of a label the triangles cover, in pixels of the picture.
struct MeshCoverage {
  std::uint32_t label_px = 0;
  double covered_px = 0.0;

  double share() const { return label_px == 0 ? 0.0 : covered_px / label_px; }
};

// Views into the workspace.
struct FoodMesh {
  std::span<const MeshPoint> points;
  std::span<const MeshTriangle> triangles;
  std::span<const MeshCoverage> coverage;  // by label
  double spacing_px = 0.0;
  int grid_points = 0;     // on food, with depth or not
  int bridged_points = 0;  // of the mesh's points, those whose depth was interpolated
};

struct FoodMeshWorkspace {
  BoundedList<MeshPoint> points;
  BoundedList<MeshTriangle> triangles;
  std::span<MeshCoverage> coverage;
  std::span<std::int32_t> columns;  // pixel columns of the grid
  std::span<std::int32_t> rows;
  std::span<std::int32_t> upper;  // indices of the points of two neighbouring rows of the grid, −1 for none
  std::span<std::int32_t> lower;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, std::size_t max_points, std::size_t max_picture_width,
                          std::size_t max_picture_height) {
    points = BoundedList<MeshPoint>(arena.template take<MeshPoint>(max_points));
    triangles = BoundedList<MeshTriangle>(arena.template take<MeshTriangle>(2 * max_points));
    coverage = arena.template take<MeshCoverage>(256);
    columns = arena.template take<std::int32_t>(max_picture_width);
    rows = arena.template take<std::int32_t>(max_picture_height);
    upper = arena.template take<std::int32_t>(max_picture_width);
    lower = arena.template take<std::int32_t>(max_picture_width);
  }
};

// Samples the food (item labels) on a regular grid whose spacing gives at most `params.points` points, as
// many as it can, and triangulates them. Every cell of the grid is a rectangle, its corners lie on a circle,
// so either diagonal is Delaunay: they alternate like a chessboard. Three corners of one label give their
// triangle; triangles that join two labels or leave the food are discarded, which erodes each label by half a
// cell (paper III-C-1). `depth_mm` and `labels` are the working picture of `camera`, of equal size.
// no_food_label without items, too_little_depth without a triangle, out_of_memory when the picture is larger
// than the workspace.
Status build_food_mesh(ImageView<const float> depth_mm, ImageView<const std::uint8_t> labels,
                       const PinholeCamera& camera, const FoodMeshParams& params,
                       FoodMeshWorkspace& workspace, FoodMesh& mesh);

}  // namespace traygauge::paper
