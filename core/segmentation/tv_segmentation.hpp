// Where on a dish food lies: every cell's own evidence, by relief, colour and texture, weighed against the
// length of the outline, which is cheap where the picture has an edge. The binary labelling of least energy
// (Boykov & Jolly, Interactive graph cuts, ICCV 2001) as its convex relaxation, by the primal-dual iterations
// of A. Chambolle, T. Pock, J. Math. Imaging Vis. 40 (2011): a fixed number of sweeps in fixed memory.
#pragma once

#include <cstdint>
#include <span>

#include "core/base/arena.hpp"
#include "core/image_view/image_view.hpp"
#include "core/segmentation/dish_raster.hpp"
#include "core/segmentation/glaze.hpp"
#include "core/segmentation/height_sample.hpp"

namespace traygauge {

struct TvSegmentationParams {
  int fold = 2;  // cells of the raster to a side of a cell of the field
  HeightWeightParams relief;
  // Evidence for food of a whole cell of the field, to be compared with `outline`.
  double lift_weight = 3.0;
  double against_weight = 1.2;  // of lift below zero: food ends low
  double colour_weight = 2.6;
  // Of a lift's weight where colour and texture are the glaze's: reflections move between the views as if
  // they stood above it.
  double plain_fraction = 0.65;
  // A dish is filled where what looks like its glaze stands this high over it but for a quarter of it, and
  // ends below the dish's edge by as much as the other: what is smooth and of the glaze's colour is then
  // food, and no reflection.
  double filled_mm = 6.0;
  double free_edge_mm = 4.0;
  double prior = -0.2;
  // Deviations of the colour from the glaze's that speak neither way, and those that count once. Others count
  // in proportion, up to `most_colour`.
  double neutral_deviations = 7.0;
  double full_deviations = 10.0;
  double most_colour = 3.0;
  // What food reflects tints the glaze in its shade, where little other light falls: by up to so many
  // deviations, without texture, and by no more than a share of the food's own.
  double shade_deviations = 5.0;
  double tint_fraction = 0.6;
  double standing_lift = 0.7;  // evidence by relief from which a cell is food, and no reflection
  // Shade begins below so much of the glaze's luma and is full by `penumbra_luma` less.
  double lit_luma = 0.9;
  double penumbra_luma = 0.1;
  double least_colour = -0.25;  // of the glaze's own colour: white food has it, too
  // Texture over the glaze's: the median of the bends over so many cells of the field to either side. Shades
  // have none, and lines such as food's own border are outnumbered.
  int texture_reach = 2;
  double neutral_texture = 2.5;
  double full_texture = 10.0;
  double texture_weight = 1.5;
  double outline = 3.0;         // for each side of a cell
  double edge_contrast = 9.0;   // of luma and twice the colour shares, that halves it
  double least_outline = 0.07;  // share that is left at the strongest edge
  int sweeps = 40;
};

struct TvSegmentationWorkspace {
  std::span<CellColour> colours;
  std::span<std::int16_t> bends;
  std::span<std::int16_t> median_bends;
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
    bends = arena.template take<std::int16_t>(cells);
    median_bends = arena.template take<std::int16_t>(cells);
    for (std::span<float>* span : {&evidence, &share, &leading, &right, &below, &right_limit, &below_limit})
      *span = arena.template take<float>(cells);
  }
};

// `cells`, of the raster's size: kFoodSeed or kGlazeSeed within the dish, kBarred outside. `relief` has the
// raster's size; cells not known in it are told by colour alone.
void segment_food(const DishRaster& raster, ImageView<const HeightSample> relief, const GlazeColour& glaze,
                  const TvSegmentationParams& params, TvSegmentationWorkspace& workspace,
                  ImageView<std::uint8_t> cells);

}  // namespace traygauge
