// The surface under the food: the rim's plane, lowered to the dish's bottom (paper III-C-2).
#pragma once

#include <cstdint>
#include <span>

#include "core/base/arena.hpp"
#include "core/base/status.hpp"
#include "core/geometry/geometry.hpp"
#include "core/paper/base/half_sample_mode.hpp"

namespace traygauge::paper {

// What defines the dish surface.
enum class DishSurface : std::uint8_t {
  rim_and_card,  // direction from the rim, height from the card (paper)
  card_alone,    // the table plane raised (paper: 15% error instead of 8.2%)
};

struct DishParams {
  DishSurface surface = DishSurface::rim_and_card;
  ModeParams mode;
};

// In the first camera, mm.
struct DishInput {
  Plane rim;
  std::span<const Vec3> rim_points_mm;   // on the rim plane
  Plane table;                           // the card's plane lowered by the card's thickness
  std::span<const Vec3> card_points_mm;  // on the card's print
  double card_thickness_mm = 0.0;
};

struct DishWorkspace {
  std::span<double> heights_mm;

  // `max_points`: rim points or card points, whichever can be more.
  template <class Allocator>
  constexpr void allocate(Allocator& arena, std::size_t max_points) {
    heights_mm = arena.template take<double>(max_points);
  }
};

// Modal height of the rim above the table: of the rim's plane over the card's points, which carries the rim's
// normal over to the small card; with `card_alone` of the rim's points over the table. table_not_found
// without card points, rim_not_found without rim points, where those are used.
Status measure_rim_height(const DishInput& input, const DishParams& params, DishWorkspace& workspace,
                          double& rim_height_mm);

// The plane of the flat bottom, `bottom_height_mm` above the table; `rim_height_mm` as measured above.
Plane place_dish_bottom(const DishInput& input, const DishParams& params, double rim_height_mm,
                        double bottom_height_mm);

}  // namespace traygauge::paper
