// Volume extraction (paper III-C): food surface, dish surface, volume of every item.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "core/base/arena.hpp"
#include "core/base/bounded_list.hpp"
#include "core/base/random.hpp"
#include "core/base/status.hpp"
#include "core/dish/rim_ellipse.hpp"
#include "core/paper/pipeline/configuration.hpp"
#include "core/paper/pipeline/dense_reconstruction.hpp"
#include "core/paper/surface/dish_surface.hpp"
#include "core/paper/surface/food_mesh.hpp"
#include "core/paper/surface/rim.hpp"
#include "core/paper/volume/mesh_volume.hpp"
#include "core/pipeline/measurement.hpp"
#include "core/pipeline/stage_clock.hpp"

namespace traygauge::paper {

// The table as the card gives it, in the reference camera, mm.
struct TableReference {
  Plane table;
  std::span<const Vec3> card_points;
};

struct VolumeExtractionWorkspace {
  FoodMeshWorkspace mesh;
  RimWorkspace rim;
  DishWorkspace dish;
  VolumeWorkspace volume;
  BoundedList<ItemResult> items;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, const Configuration& configuration) {
    const Caps& caps = configuration.caps;
    const auto points = static_cast<std::size_t>(configuration.mesh.points);
    const auto side = static_cast<std::size_t>(caps.max_working_side_px);
    // A convex border has two sides for each row and each column; notches and stairs of hand-drawn ones
    // double it.
    const std::size_t border_sides = 8 * side;
    mesh.allocate(arena, points, side, side);
    rim.allocate(arena, border_sides, border_sides);
    dish.allocate(arena, std::max(border_sides, static_cast<std::size_t>(caps.max_pattern_keypoints)));
    volume.allocate(arena, points);
    items = BoundedList<ItemResult>(arena.template take<ItemResult>(kMaxItems));
  }
};

// Finds the plane of the dish's bottom: rim, modal height over the table, shift (paper III-C-2).
Status find_dish_bottom(const ReferencePair& pair, const TableReference& table,
                        const Configuration& configuration, Random& random,
                        VolumeExtractionWorkspace& workspace, MeasurementReport& report,
                        WorkingPictures& pictures, MeasurementViews& views);

// Mesh and volumes above `views.dish_bottom` into `workspace.items`; ok, partial, or why nothing was
// measured.
Status extract_volumes(const ReferencePair& pair, const Configuration& configuration,
                       VolumeExtractionWorkspace& workspace, StageClock& clock, WorkingPictures& pictures,
                       MeasurementViews& views);

}  // namespace traygauge::paper
