// The food on one dish in one view: cells that are not its glaze, in items.
#pragma once

#include <cstdint>
#include <span>

#include "core/base/arena.hpp"
#include "core/segmentation/dish_raster.hpp"
#include "core/segmentation/geodesic.hpp"
#include "core/segmentation/glaze.hpp"

namespace traygauge {

struct FoodOutlineParams {
  DishRasterParams raster;
  GlazeParams glaze;
  GeodesicParams geodesic;
  double smoothing_mm = 2.0;    // radius of the majority that smooths outlines
  double min_item_mm2 = 250.0;  // smaller is a crumb, a drop or a highlight
  double min_hole_mm2 = 150.0;  // of glaze within food; smaller is food
};

struct FoodOutlineWorkspace {
  DishRasterWorkspace raster;
  GeodesicWorkspace geodesic;
  std::span<std::uint8_t> owners;
  std::span<std::uint8_t> smoothed;
  std::span<std::int32_t> queue;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, const FoodOutlineParams& params) {
    const auto cells = static_cast<std::size_t>(params.raster.max_cells);
    raster.allocate(arena, params.raster);
    geodesic.allocate(arena, params.raster.max_cells);
    owners = arena.template take<std::uint8_t>(cells);
    smoothed = arena.template take<std::uint8_t>(cells);
    queue = arena.template take<std::int32_t>(cells);
  }
};

// Cells of `raster` as labels: kBackgroundLabel outside of the dish, kDishLabel on it, kFirstItemLabel and on
// the items. Returns their number; −1 when the flange shows too little glaze.
int outline_food(const DishRaster& raster, const FoodOutlineParams& params, FoodOutlineWorkspace& workspace,
                 ImageView<std::uint8_t> labels);

}  // namespace traygauge
