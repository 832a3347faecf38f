// Where on a dish food lies: every cell's own evidence weighed against the length of the outline, which is
// cheap where the picture has an edge. The binary labelling of least energy (Boykov & Jolly, Interactive
// graph cuts, ICCV 2001) as its convex relaxation, by the primal-dual iterations of A. Chambolle, T. Pock, J.
// Math. Imaging Vis. 40 (2011): a fixed number of sweeps in fixed memory.
#pragma once

#include <cstdint>
#include <span>

#include "core/base/arena.hpp"
#include "core/image_view/image_view.hpp"
#include "core/segmentation/dish_raster.hpp"
#include "core/segmentation/food_evidence.hpp"
#include "core/segmentation/glaze.hpp"

namespace traygauge {

struct TvSegmentationParams {
  int fold = 2;  // cells of the raster to a side of a cell of the field
  FoodEvidenceParams evidence;
  double outline = 3.0;         // for each side of a cell, in log odds
  double edge_contrast = 9.0;   // of luma and twice the colour shares, that halves it
  double least_outline = 0.07;  // share that is left at the strongest edge
  int sweeps = 40;
};

struct TvSegmentationWorkspace {
  std::span<CellColour> colours;
  std::span<float> evidence;
  std::span<float> share;    // of food, 0 to 1
  std::span<float> leading;  // extrapolated
  std::span<float> right;    // flow across each cell's right side
  std::span<float> below;
  std::span<float> right_limit;
  std::span<float> below_limit;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, int max_cells) {
    const auto cells = static_cast<std::size_t>(max_cells);
    colours = arena.template take<CellColour>(cells);
    for (std::span<float>* span : {&evidence, &share, &leading, &right, &below, &right_limit, &below_limit})
      *span = arena.template take<float>(cells);
  }
};

// `cells`, of the raster's size: kFoodSeed or kGlazeSeed within the dish, kBarred outside.
void segment_food(const DishInView& dish, const GlazeColour& glaze, const FoodWeights& weights,
                  const TvSegmentationParams& params, TvSegmentationWorkspace& workspace,
                  ImageView<std::uint8_t> cells);

}  // namespace traygauge
