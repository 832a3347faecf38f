// Which item a place of food belongs to: the one in which the colours about it are most common, and that is
// near. Mixed food has many colours, of which its neighbour may share some; a mean says less than how often
// each occurs (as in C. Rother et al., GrabCut, SIGGRAPH 2004, by histograms and without a cut).
#pragma once

#include <cstdint>
#include <span>

#include "core/base/arena.hpp"
#include "core/image_view/image_view.hpp"
#include "core/segmentation/dish_raster.hpp"

namespace traygauge {

// Half or twice of any number here moves the MAPE of six pairs of the captures with found outlines by 0.13
// points at most (tests/evaluation/numbers.tsv), but for twice of window_mm: 0.29.
struct ItemAssignmentParams {
  int fold = 2;            // cells of the raster to a side of a cell that is assigned
  double window_mm = 7.0;  // to either side, over which colours are compared; twice as far for what is near
  double nearness = 2.0;   // weight of the logarithm of an item's share of what is near, beside the colours'
  int rounds = 5;          // after each, an item's colours are counted anew
};

struct ItemAssignmentWorkspace {
  std::span<std::uint8_t> labels;  // 0: not yet known
  std::span<std::uint8_t> next;
  std::span<std::uint8_t> colours;  // in classes
  std::span<bool> is_food;
  std::span<std::uint16_t> seen;  // food within the window
  std::span<std::uint16_t> near;  // food within twice the window
  std::span<std::uint16_t> own;   // of it, of the item that is tried
  std::span<float> scores;
  std::span<std::int32_t> row_sums;
  std::span<std::int32_t> column_sums;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, int max_cells, const ItemAssignmentParams& params) {
    const auto cells = static_cast<std::size_t>(max_cells / (params.fold * params.fold));
    for (std::span<std::uint8_t>* span : {&labels, &next, &colours})
      *span = arena.template take<std::uint8_t>(cells);
    is_food = arena.template take<bool>(cells);
    for (std::span<std::uint16_t>* span : {&seen, &near, &own})
      *span = arena.template take<std::uint16_t>(cells);
    scores = arena.template take<float>(cells);
    row_sums = arena.template take<std::int32_t>(cells);
    column_sums = arena.template take<std::int32_t>(cells);
  }
};

// `cells`: items' labels where they are known, `unknown` on other food. Gives food labels, or takes them
// where another item's fit better; next to a border between items food becomes `unknown`.
void assign_items(const DishRaster& raster, std::uint8_t unknown, const ItemAssignmentParams& params,
                  ItemAssignmentWorkspace& workspace, ImageView<std::uint8_t> cells);

}  // namespace traygauge
