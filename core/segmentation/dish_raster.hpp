// What one view shows of a dish, in cells of some pixels: colour, and which part of the dish lies there.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/base/arena.hpp"
#include "core/geometry/geometry.hpp"
#include "core/image_view/image_view.hpp"
#include "core/labels/label_regions.hpp"

namespace traygauge {

// Half or twice of any number here moves the MAPE of six pairs of the captures with found outlines by 0.12
// points at most (tests/evaluation/numbers.tsv), but for twice of cell_mm (3.7, with the glossy egg of m06)
// and half of max_cells (0.55).
struct DishRasterParams {
  double cell_mm = 1.0;      // about; cells are whole pixels
  int max_cells = 105'000;   // 360 × 290 mm at that size
  double dark_level = 12.0;  // grey value below which a colour tells little
};

// Colour of a cell: luma, and the shares of red and green in its light (1/255 of twice the share, squares of
// the values standing for light), which a shadow leaves as they are.
struct CellColour {
  std::uint8_t luma = 0;
  std::uint8_t red = 0;
  std::uint8_t green = 0;
};

// Part of the dish that a cell shows.
enum class DishZone : std::uint8_t {
  outside,
  edge,    // where the outer edge and what is behind it may mix
  flange,  // the glaze that food hardly covers
  inside,
};

struct DishRaster {
  int left_px = 0;  // of the frame
  int top_px = 0;
  int step_px = 1;
  double cell_mm = 1.0;
  ImageView<CellColour> colours;
  ImageView<DishZone> zones;

  int width() const { return colours.width; }
  int height() const { return colours.height; }
  Vec2 cell_of(const Vec2& pixel) const {
    return {(pixel.x() - left_px + 0.5) / step_px - 0.5, (pixel.y() - top_px + 0.5) / step_px - 0.5};
  }
  Vec2 pixel_of(double x, double y) const {
    return {left_px + (x + 0.5) * step_px - 0.5, top_px + (y + 0.5) * step_px - 0.5};
  }
};

struct DishRasterWorkspace {
  std::span<CellColour> colours;
  std::span<DishZone> zones;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, const DishRasterParams& params) {
    const auto cells = static_cast<std::size_t>(params.max_cells);
    colours = arena.template take<CellColour>(cells);
    zones = arena.template take<DishZone>(cells);
  }
};

// The box around `outline_px`, at `px_per_mm`; all cells outside. False when it does not meet the frame.
bool load_dish_raster(const FrameView& frame, std::span<const Vec2> outline_px, double px_per_mm,
                      const DishRasterParams& params, DishRasterWorkspace& workspace, DishRaster& raster);

// Marks the cells within a convex outline of frame pixels.
void mark_zone(DishRaster& raster, std::span<Vec2> outline_px, DishZone zone);

}  // namespace traygauge
