// One height map over the dish from what both views see: volumes are integrals over it.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/arena.hpp"
#include "core/base/status.hpp"
#include "core/dish/dish_profile.hpp"
#include "core/geometry/geometry.hpp"
#include "core/image_view/image_view.hpp"
#include "core/stereo/surface_grid.hpp"

namespace traygauge {

enum class CellKind : std::uint8_t {
  unseen,   // no line of sight crosses it
  hidden,   // below lines of sight only: they bound its surface from above
  surface,  // seen
};

struct HeightCell {
  float z_mm = 0.0F;       // of the upper surface; its upper bound while a cell is hidden and not yet filled
  float below_mm = 0.0F;   // hidden: where the bounding line of sight ends
  std::uint8_t label = 0;  // of the surface; of what hides it while it is hidden and not yet filled
  // Hidden: of what the bounding line of sight ends on. Surface: of another surface that a view sees well
  // below this one, which overhangs it; 0 without.
  std::uint8_t below_label = 0;
  CellKind kind = CellKind::unseen;
  std::uint8_t weight = 0;  // squared cosine between surface normal and line of sight, of 255
};

// The weight of a surface beyond its last sample; seen ones weigh more.
inline constexpr std::uint8_t kExtrapolatedWeight = 1;

struct HeightMap {
  ImageView<HeightCell> cells;
  double cell_mm = 0.0;
  Vec2 origin_mm = Vec2::Zero();  // table frame: the centre of cell (0, 0); axes as the table's

  Vec2 centre_mm(int x, int y) const { return origin_mm + cell_mm * Vec2(x, y); }
};

// Half or twice of any number here moves the MAPE of six pairs of the captures by 0.06 points at most
// (tests/evaluation/numbers.tsv), but for jump_cosine (+0.16), min_flank_threshold (+0.12 and -0.27) and
// hidden_steepness (+0.67 and -0.32), which is chosen on the captures (tests/evaluation/experiments.md); half
// of cell_mm needs more cells than there are.
struct HeightMapParams {
  // Smaller cells resolve outlines better, which the volume hardly needs: cell centres sample an area without
  // bias. About the samples' distance on the dish; larger loses narrow crevices, smaller takes time.
  double cell_mm = 0.85;
  // A patch seen at a smaller cosine spans an occlusion: 0.3 is 3.2 samples' distance in depth from one
  // sample to the next. Larger takes steep flanks for occlusions, smaller counts the sheets behind edges.
  double jump_cosine = 0.3;
  // Views further apart than this do not see the same surface: the better seen one holds.
  double disagreement_mm = 3.0;
  // So far below another surface a sample lies under an overhang, not on a wall's blurred foot.
  double undercut_mm = 4.0;
  // Hidden flanks fall like the item's seen ones that are too steep to be seen from behind. Where the views
  // look straight down these are walls alone: with a larger greatest threshold none are found, with a smaller
  // one heaps count as walls. Below the least, noise does.
  double min_flank_threshold = 1.5;
  double max_flank_threshold = 4.0;
  // Twice the line of sight's slope counts as so much seen flank (its area from above).
  double prior_flank_mm2 = 5.0;
  // Hidden flanks fall so many times as fast as those that were matched, which blunts them; 1 with true
  // depth.
  double hidden_steepness = 2.0;
  // A hole that no line of sight crosses is filled so far from its edge.
  double max_hole_mm = 6.0;
};

struct HeightMapWorkspace {
  struct Source {
    std::int16_t x = -1;  // the nearest known cell; −1: none yet
    std::int16_t y = -1;
  };

  // A sample in cells from the map's first cell; all three axes have the same unit.
  struct Corner {
    float x = 0.0F;
    float y = 0.0F;
    float z = 0.0F;
    std::uint8_t label = 0;
    bool known = false;
  };
  static constexpr std::size_t kCornerRows = 3;  // a row and its neighbours

  std::span<HeightCell> second;  // what the second view sees
  std::span<Corner> corners;     // of the samples' rows at work
  std::span<Source> sources;     // in the memory of `second`, which is fused by then

  template <class Allocator>
  constexpr void allocate(Allocator& arena, std::size_t max_cells, std::size_t max_grid_width) {
    corners = arena.template take<Corner>(kCornerRows * max_grid_width);
    static_assert(sizeof(Source) <= sizeof(HeightCell));
    arena.overlay([&] { sources = arena.template take<Source>(max_cells); },
                  [&] { second = arena.template take<HeightCell>(max_cells); });
  }
};

// The fused map in `cells`: every cell of the dish's bounding box has the height and label of the
// upper surface there. Where both views see it, their mean by weight; where one, its own. A patch between
// samples whose line of sight grazes it is no surface, but nothing lies above it (space carving, Kutulakos &
// Seitz 2000): under it a cell is hidden. A cell hidden from all views continues the item that hides it
// (occluded_cells.hpp), or else what is seen at the sheet's foot, level. `kind` stays hidden for filled
// cells. Grids without points count as no view. out_of_memory when the dish has more cells than `cells` or
// the workspace, or a grid wider rows; too_little_depth when nothing is seen; invalid_configuration for a
// cell size that is not positive; wrong_call for a dish without a finite place.
Status build_height_map(std::span<const SurfaceGrid> views, const InnerSurface& dish,
                        const HeightMapParams& params, std::span<HeightCell> cells,
                        HeightMapWorkspace& workspace, HeightMap& map);

}  // namespace traygauge
