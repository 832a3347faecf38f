// Food beside the dishes: where the network sees it on the tray in both views, that place of the tray is
// looked at like a dish.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/base/bounded_list.hpp"
#include "core/labels/convex_fill.hpp"
#include "core/pipeline/segmenter.hpp"
#include "core/pipeline/table_rectangle.hpp"
#include "core/segmentation/components.hpp"
#include "core/segmentation/geodesic.hpp"
#include "core/segmentation/neighbours.hpp"

namespace traygauge {
namespace {

constexpr std::size_t kMostSeen = 32;  // pieces of food beside the dishes, in one view

// Cells that the network takes for food, where the picture shows neither card nor dish.
void mark_food_beside(const PictureReading& reading, ImageView<const std::uint8_t> labels,
                      ImageView<std::uint8_t> cells) {
  for (int y = 0; y < cells.height; ++y) {
    for (int x = 0; x < cells.width; ++x) {
      const Vec2 pixel = reading.pixel_of(x, y);
      const auto column = static_cast<int>(std::lround(pixel.x()));
      const auto row = static_cast<int>(std::lround(pixel.y()));
      std::uint8_t& cell = cells.at(x, y);
      cell = kBarred;
      if (!labels.contains(column, row) || labels.at(column, row) != kBackgroundLabel) continue;
      cell = reading.margins.at(x, y) > 0 ? kFoodSeed : kGlazeSeed;
    }
  }
}

// Of a component's border, the share along what is no tray.
double barred_share(std::span<const std::int32_t> component, ImageView<const std::uint8_t> cells) {
  int all = 0;
  int barred = 0;
  const int count = cells.width * cells.height;
  for (const std::int32_t cell : component) {
    for_each_neighbour(cell, cells.width, count, [&](int beside) {
      if (cells.data[beside] == kVisited) return;
      ++all;
      barred += cells.data[beside] == kBarred ? 1 : 0;
    });
  }
  return all > 0 ? static_cast<double>(barred) / all : 1.0;
}

PixelBox box_of(std::span<const std::int32_t> component, const PictureReading& reading, int width) {
  PixelBox box;
  for (const std::int32_t cell : component) {
    const int column = cell % width;
    const int row = cell / width;
    const auto at = [&](double half) { return reading.pixel_of(column + half, row + half); };
    const Vec2 first = at(-0.5);
    const Vec2 last = at(0.5);
    box = united(box, {static_cast<int>(first.x()), static_cast<int>(first.y()),
                       static_cast<int>(last.x()) + 1, static_cast<int>(last.y()) + 1});
  }
  return box;
}

}  // namespace

// Where on the table each of them may stand, whether it is flat or high.
BoundedList<TableRectangle> Segmenter::see_food_beside(std::size_t v, std::span<TableRectangle> storage) {
  BoundedList<TableRectangle> seen(storage);
  const PictureReading& reading = readings_[v];
  const TrayPlaceParams& params = params_.tray;
  const DishSearchView& camera = cameras_[v];
  const ImageView<std::uint8_t> cells{memory_.food.cells.data(), reading.margins.width,
                                      reading.margins.height};
  const int count = cells.width * cells.height;
  if (static_cast<std::size_t>(count) > memory_.food.cells.size()) return seen;
  mark_food_beside(reading, views_[v].labels, cells);
  Components components(cells, memory_.food.outline.queue);
  for (int cell = 0; cell < count; ++cell) {
    if (cells.data[cell] != kFoodSeed) continue;
    const auto component = components.repaint(cell, kVisited);
    if (barred_share(component, cells) <= params.max_barred_share) {
      const PixelBox box = box_of(component, reading, cells.width);
      const bool is_whole =
          box.left > 0 && box.top > 0 && box.right < reading.frame_width && box.bottom < reading.frame_height;
      TableRectangle place;
      const bool is_on_table =
          is_whole && include_box(camera.lens, camera.camera_from_table, box, 0.0, place) &&
          place.area_mm2() >= params.min_area_mm2 &&
          include_box(camera.lens, camera.camera_from_table, box, params.most_height_mm, place);
      if (is_on_table) seen.push_back(place);
    }
    for (const std::int32_t done : component) cells.data[done] = kGlazeSeed;
  }
  return seen;
}

// Behind the dishes, as many as there is room for. Where a dish was not found, food may be that dish's.
void Segmenter::find_tray_places() {
  result_.place_count = 0;
  if (!result_.has_all_dishes()) return;
  std::array<std::array<TableRectangle, kMostSeen>, 2> storage;
  const BoundedList<TableRectangle> first = see_food_beside(0, storage[0]);
  const BoundedList<TableRectangle> second = see_food_beside(1, storage[1]);
  std::array<TableRectangle, kMostSeen> places;
  std::size_t seen = 0;
  for (const TableRectangle& one : first.items()) {
    TableRectangle place;
    for (const TableRectangle& other : second.items()) {
      const TableRectangle shared = one.shared_with(other);
      if (shared.area_mm2() >= params_.tray.min_shared * std::min(one.area_mm2(), other.area_mm2()))
        place.include(shared);
    }
    if (!place.empty()) places[seen++] = place;
  }
  // What lies near another piece is looked at with it.
  const std::size_t count = join_near(std::span(places).first(seen), params_.tray.around_mm);
  const std::size_t room = std::min(kMaxTrayPlaces, result_.dishes.size() - result_.dish_count);
  result_.leaves_food = count > room;
  for (const TableRectangle& place : std::span(places).first(std::min(count, room))) {
    SegmentedDish& ground = result_.dishes[result_.dish_count + result_.place_count];
    ground = {};
    ground.label = static_cast<std::uint8_t>(kFirstTrayPlace + result_.place_count++);
    const Vec2 size_mm = std::numbers::sqrt2 * place.size_mm() + Vec2::Constant(2.0 * params_.tray.around_mm);
    ground.model.label = ground.label;
    ground.model.outer_size_mm = {size_mm.x(), size_mm.y()};
    ground.found.place.centre_mm = place.middle_mm();
    ground.found.place.size_mm = ground.model.outer_size_mm;
  }
}

// Over the tray alone; what lay on it is drawn anew.
void Segmenter::draw_tray_places() const {
  for (const SegmentedDish& place : result_.places()) {
    for (std::size_t v = 0; v < 2; ++v) {
      const ImageView<std::uint8_t> labels = views_[v].labels;
      const RimOutline outline = rim_outline(place.found.place, cameras_[v], 0.0, 0.0);
      for_each_covered_row(labels.width, labels.height, outline, [&](int y, int left, int right) {
        for (int x = left; x < right; ++x) {
          if (labels.at(x, y) != kCardLabel) labels.at(x, y) = place.label;
        }
      });
    }
  }
}

// Of the place's cells those that show a dish, the card or another place.
void Segmenter::leave_out_others(const SegmentedDish& place, std::size_t v, DishRaster& raster) const {
  const ImageView<const std::uint8_t> labels = views_[v].labels;
  for (int y = 0; y < raster.height(); ++y) {
    for (int x = 0; x < raster.width(); ++x) {
      const Vec2 pixel = raster.pixel_of(x, y);
      const int column = static_cast<int>(pixel.x());
      const int row = static_cast<int>(pixel.y());
      if (!labels.contains(column, row) || labels.at(column, row) != place.label)
        raster.zones.at(x, y) = DishZone::outside;
    }
  }
}

// What stands on the tray is food where the network says so: its rim, a cup and cutlery stand as well.
void Segmenter::keep_seen_food(const DishRaster& raster, std::size_t v, ImageView<std::uint8_t> cells) const {
  Components components(cells, memory_.food.outline.queue);
  const int count = cells.width * cells.height;
  for (int cell = 0; cell < count; ++cell) {
    if (cells.data[cell] != kFoodSeed) continue;
    const auto component = components.repaint(cell, kVisited);
    const auto seen = std::ranges::count_if(component, [&](std::int32_t of_it) {
      const int column = of_it % cells.width;
      const int row = of_it / cells.width;
      return readings_[v].margin_at(raster.pixel_of(column, row)) > 0.0F;
    });
    if (2 * static_cast<std::size_t>(seen) >= component.size()) continue;
    for (const std::int32_t of_it : component) cells.data[of_it] = kGlazeSeed;
  }
  std::replace(cells.data, cells.data + count, kVisited, kFoodSeed);
}

void Segmenter::clear_tray_places() const {
  if (result_.place_count == 0) return;
  for (const SegmentedView& view : views_) {
    for (int y = 0; y < view.labels.height; ++y) {
      for (int x = 0; x < view.labels.width; ++x) {
        std::uint8_t& label = view.labels.at(x, y);
        if (is_tray_place(label)) label = kBackgroundLabel;
      }
    }
  }
}

}  // namespace traygauge
