#include "core/segmentation/food_outline.hpp"

#include <algorithm>

#include "core/segmentation/components.hpp"
#include "core/segmentation/neighbours.hpp"
#include "core/segmentation/square_sums.hpp"

namespace traygauge {
namespace {

bool has_labelled_neighbour(ImageView<const std::uint8_t> cells, std::span<const std::int32_t> visited) {
  const int count = cells.width * cells.height;
  return std::any_of(visited.begin(), visited.end(), [&](std::int32_t cell) {
    bool is_labelled = false;
    for_each_neighbour(cell, cells.width, count,
                       [&](int neighbour) { is_labelled |= is_item(cells.data[neighbour]); });
    return is_labelled;
  });
}

// Calls decide(cell, food) for every cell within the dish, with the number of cells of food in the square
// about it.
template <class Decide>
void for_each_square(ImageView<std::uint8_t> cells, int radius, FoodOutlineWorkspace& workspace,
                     Decide&& decide) {
  for_each_square_sum(
      cells.width, cells.height, radius, workspace.sums, workspace.column_sums,
      [&](int x, int y) { return cells.at(x, y) == kFoodSeed ? 1 : 0; },
      [&](int x, int y, int food) {
        if (cells.at(x, y) != kBarred) decide(cells.at(x, y), food);
      });
}

// Food where at least `least_fraction` of the square about a cell is.
void threshold_fraction(ImageView<std::uint8_t> cells, int radius, double least_fraction,
                        FoodOutlineWorkspace& workspace) {
  const int least = least_of_square(radius, least_fraction);
  for_each_square(cells, radius, workspace,
                  [&](std::uint8_t& cell, int food) { cell = food >= least ? kFoodSeed : kGlazeSeed; });
}

// Takes the owner from cells that are near to the other kind.
void free_band(ImageView<std::uint8_t> cells, int radius, FoodOutlineWorkspace& workspace) {
  const int side = 2 * radius + 1;
  for_each_square(cells, radius, workspace, [&](std::uint8_t& cell, int food) {
    if (food > 0 && food < side * side) cell = kNoOwner;
  });
}

// Where a network denies a part of a food it denies all of it. So around kStandingFood the other signs
// decide: it becomes kFoodSeed, and so does what they call food and is connected to it.
void complete_standing_food(const DishInView& dish, const GlazeColour& glaze, const FoodOutlineParams& params,
                            FoodOutlineWorkspace& workspace, ImageView<std::uint8_t> cells) {
  constexpr std::uint8_t kDenied = kStandingFood + 1;
  const ImageView<std::uint8_t> without_network{workspace.sums.data(), cells.width, cells.height};
  segment_food({dish.raster, dish.relief, dish.reading}, glaze, params.field.evidence.where_denied(),
               params.field, workspace.field, without_network);
  const int count = cells.width * cells.height;
  for (int cell = 0; cell < count; ++cell) {
    if (cells.data[cell] == kGlazeSeed && without_network.data[cell] == kFoodSeed) cells.data[cell] = kDenied;
  }
  spread_through(cells, kStandingFood, kDenied, workspace.queue);
  std::replace(cells.data, cells.data + count, kStandingFood, kFoodSeed);
  std::replace(cells.data, cells.data + count, kDenied, kGlazeSeed);
}

}  // namespace

OutlinedFood outline_food(const DishInView& dish, const FoodOutlineParams& params,
                          FoodOutlineWorkspace& workspace, ImageView<std::uint8_t> cells) {
  const DishRaster& raster = dish.raster;
  GlazeColour glaze;
  if (!measure_glaze(raster, params.glaze, glaze)) return {};
  const auto radius_of = [&](double radius_mm) { return square_radius(radius_mm, raster.cell_mm); };
  segment_food(dish, glaze, params.field.evidence.usual(), params.field, workspace.field, cells);
  OutlinedFood outlined{true};
  outlined.is_told_by_height =
      dish.holds_only_food &&
      add_standing_food(raster, dish.relief, params.field.evidence.relief, params.standing,
                        params.min_item_mm2, {workspace.sums, workspace.column_sums, workspace.queue}, cells);
  if (outlined.is_told_by_height) complete_standing_food(dish, glaze, params, workspace, cells);
  free_band(cells, radius_of(params.band_mm), workspace);
  spread_owners(raster.colours, workspace.geodesic, cells);
  threshold_fraction(cells, radius_of(params.smoothing_mm), 0.5, workspace);
  // An opening: all of the square, then any of it.
  const int opening = radius_of(params.opening_mm);
  threshold_fraction(cells, opening, 1.0, workspace);
  threshold_fraction(cells, opening, 0.5 / ((2.0 * opening + 1.0) * (2.0 * opening + 1.0)), workspace);
  const double min_cells = params.min_item_mm2 / (raster.cell_mm * raster.cell_mm);
  drop_small(cells, kFoodSeed, kGlazeSeed, min_cells, workspace.queue);
  drop_small(cells, kGlazeSeed, kFoodSeed, min_cells, workspace.queue);
  return outlined;
}

ItemSplit label_items(const DishRaster& raster, const PictureReading& reading,
                      const FoodOutlineParams& params, FoodOutlineWorkspace& workspace, std::uint8_t first,
                      int max_items, ImageView<std::uint8_t> cells) {
  // Items are drawn on cells where food has no meaning of its own.
  const int count = raster.width() * raster.height();
  for (int cell = 0; cell < count; ++cell) {
    if (cells.data[cell] == kFoodSeed) cells.data[cell] = kUnlabelled;
  }
  ItemSplit split =
      split_items(raster, reading, kUnlabelled, params.split, workspace.split, first, max_items, cells);
  // What has no block of its own is an item as it is.
  Components components(cells, workspace.queue);
  for (int cell = 0; cell < count; ++cell) {
    if (cells.data[cell] != kUnlabelled) continue;
    const auto visited = components.repaint(cell, kVisited);
    if (split.items >= max_items || has_labelled_neighbour(cells, visited)) continue;
    for (const std::int32_t i : visited) cells.data[i] = static_cast<std::uint8_t>(first + split.items);
    ++split.items;
  }
  for (int cell = 0; cell < count; ++cell) {
    if (cells.data[cell] == kVisited) cells.data[cell] = kUnlabelled;
  }
  spread_items(raster, params, workspace, cells);
  return split;
}

void spread_items(const DishRaster& raster, const FoodOutlineParams& params, FoodOutlineWorkspace& workspace,
                  ImageView<std::uint8_t> cells) {
  assign_items(raster, kUnlabelled, params.assignment, workspace.assignment, cells);
  const int count = raster.width() * raster.height();
  // The dish is barred while items spread over the food; zones tell it from what is outside.
  for (int cell = 0; cell < count; ++cell) {
    std::uint8_t& owner = cells.data[cell];
    if (owner == kGlazeSeed) owner = kBarred;
    if (owner == kUnlabelled) owner = kNoOwner;
  }
  spread_owners(raster.colours, workspace.geodesic, cells);
  for (int cell = 0; cell < count; ++cell) {
    std::uint8_t& owner = cells.data[cell];
    if (raster.zones.data[cell] == DishZone::outside) {
      owner = kBackgroundLabel;
    } else if (!is_item(owner)) {
      owner = kDishLabel;
    }
  }
}

}  // namespace traygauge
