// Volume under the food surface (paper III-C-3): for each triangle its horizontal area times the mean height
// of its corners, summed per label. The paper's areas have no sign: a finer mesh than its 2^12 points counts
// noise of the depth as volume, which is why its Table IV has a minimum.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/status.hpp"
#include "core/geometry/geometry.hpp"
#include "core/paper/surface/food_mesh.hpp"

namespace traygauge::paper {

struct ItemVolume {
  std::uint8_t label = 0;
  double volume_ml = 0.0;
  double area_mm2 = 0.0;        // horizontal
  double mean_height_mm = 0.0;  // volume / area
  double max_height_mm = 0.0;
};

struct VolumeParams {
  // Quantile of the heights of an item's points that is its greatest height: 1 is the highest point, which
  // depth noise pushes up; lower cuts peaks.
  double max_height_quantile = 0.998;
};

struct VolumeWorkspace {
  std::span<ItemVolume> items;  // by label
  std::span<float> heights_mm;  // of the points, label by label

  template <class Allocator>
  constexpr void allocate(Allocator& arena, std::size_t max_points) {
    items = arena.template take<ItemVolume>(256);
    heights_mm = arena.template take<float>(max_points);
  }
};

// Integrates each label of `mesh` above `dish_bottom` (mm, in the frame of the mesh, normal up) into
// `workspace.items`; labels without triangles stay zero. Surface below the plane counts negative. The mean of
// the corners is exact for a plane over a triangle. too_little_depth for an empty mesh, out_of_memory for
// more points than the workspace holds.
Status integrate_volume(const FoodMesh& mesh, const Plane& dish_bottom, const VolumeParams& params,
                        VolumeWorkspace& workspace);

}  // namespace traygauge::paper
