// The food on one dish in one view: cells that are not its glaze, in items.
#pragma once

#include <cstdint>
#include <span>

#include "core/base/arena.hpp"
#include "core/segmentation/dish_raster.hpp"
#include "core/segmentation/food_evidence.hpp"
#include "core/segmentation/geodesic.hpp"
#include "core/segmentation/glaze.hpp"
#include "core/segmentation/item_assignment.hpp"
#include "core/segmentation/item_split.hpp"
#include "core/segmentation/picture_reading.hpp"
#include "core/segmentation/standing_food.hpp"
#include "core/segmentation/tv_segmentation.hpp"

namespace traygauge {

inline constexpr std::uint8_t kUnlabelled =
    kLastFurtherDishLabel + 2;  // food of which it is not known yet to which item it belongs

// Half or twice of any number here moves the MAPE of six pairs of the captures with found outlines by 0.23
// points at most (tests/evaluation/numbers.tsv); of min_item_mm2 it changes nothing.
struct FoodOutlineParams {
  DishRasterParams raster;
  GlazeParams glaze;
  ItemSplitParams split;
  ItemAssignmentParams assignment;
  TvSegmentationParams field;
  StandingFoodParams standing;
  double band_mm = 3.0;         // to either side of the field's outline, in which the picture's edges decide
  double smoothing_mm = 1.6;    // radius of the majority that smooths outlines
  double opening_mm = 2.4;      // radius of what fits into food: rings of decoration and bridges do not
  double min_item_mm2 = 250.0;  // smaller is a crumb, a drop or a highlight; so is glaze within food
};

struct FoodOutlineWorkspace {
  DishRasterWorkspace raster;
  std::span<HeightSample> relief;
  std::span<std::uint8_t> sums;
  std::span<std::int32_t> queue;
  // Each used while the others are not, in the same memory.
  TvSegmentationWorkspace field;
  std::span<std::int32_t> column_sums;
  ItemSplitWorkspace split;
  ItemAssignmentWorkspace assignment;
  GeodesicWorkspace geodesic;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, const FoodOutlineParams& params) {
    const auto cells = static_cast<std::size_t>(params.raster.max_cells);
    raster.allocate(arena, params.raster);
    relief = arena.template take<HeightSample>(cells);
    sums = arena.template take<std::uint8_t>(cells);
    queue = arena.template take<std::int32_t>(cells);
    arena.overlay(
        [&] { field.allocate(arena, params.raster.max_cells / (params.field.fold * params.field.fold)); },
        // A raster has three rows and more.
        [&] { column_sums = arena.template take<std::int32_t>(cells / 3); },
        [&] { split.allocate(arena, params.split); },
        [&] { assignment.allocate(arena, params.raster.max_cells, params.assignment); },
        [&] { geodesic.allocate(arena, params.raster.max_cells); });
  }
};

struct OutlinedFood {
  bool is_outlined = false;        // not where the flange shows too little glaze
  bool is_told_by_height = false;  // some of it, and by nothing else
};

// Marks the cells of food as kFoodSeed, the rest of the dish as kGlazeSeed, kBarred outside.
OutlinedFood outline_food(const DishInView& dish, const FoodOutlineParams& params,
                          FoodOutlineWorkspace& workspace, ImageView<std::uint8_t> cells);

// Gives the food items labels from `first` on, kDishLabel to the rest of the dish and kBackgroundLabel
// outside; `cells` as outline_food left them. There are at most `max_items`.
ItemSplit label_items(const DishRaster& raster, const PictureReading& reading,
                      const FoodOutlineParams& params, FoodOutlineWorkspace& workspace, std::uint8_t first,
                      int max_items, ImageView<std::uint8_t> cells);

// The same with seeds that are known already: cells that carry an item's label, among food that is
// kUnlabelled. Food that no seed reaches is dish.
void spread_items(const DishRaster& raster, const FoodOutlineParams& params, FoodOutlineWorkspace& workspace,
                  ImageView<std::uint8_t> cells);

}  // namespace traygauge
