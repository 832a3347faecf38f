// Dishes of known size in pictures without labels. The card gives the table, so that a rim is an ellipse of
// known axes on a plane of known height: the edges of both views vote for its centre and azimuth (Hough's
// transform generalised to known shapes, Ballard 1981), and the best places are confirmed and refined by the
// rim's own edge in the full pictures.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/arena.hpp"
#include "core/base/bounded_list.hpp"
#include "core/base/result.hpp"
#include "core/dish/dish_pose.hpp"
#include "core/dish/rim_edges.hpp"
#include "core/geometry/camera.hpp"
#include "core/geometry/geometry.hpp"
#include "core/geometry/table_frame.hpp"
#include "core/image_view/image_view.hpp"

namespace traygauge {

// Chosen on the captures' dishes, and sharply: half or twice of cells, azimuths, bands, samples, sure_step or
// edge_reach_mm costs six pairs of the captures with found outlines 2 to 6 points, two of them by the glossy
// egg of m06, which turns over after most changes (tests/evaluation/numbers.tsv).
struct DishSearchParams {
  RimEdgeParams edges;
  DishPoseParams placement;
  double cell_mm = 4.0;  // of the votes for the centre
  int azimuths = 24;     // of an oval's axis over half a turn: 7.5 degrees apart
  // Along the rim the picture is compared over this width on either side.
  double band_mm = 1.5;
  double sample_mm = 0.3;
  double vote_reach_mm = 10.0;  // of the search for the place at which most of the rim shows an edge
  // The same in one view alone, where the dish may have slipped: shifts by 0.8 of it, over as much of a
  // profile as there is room for.
  double slip_reach_mm = 12.5;
  double shift_step_mm = 1.0;
  int azimuth_steps = 7;       // between two azimuths that were voted for: about a degree each
  double same_place_mm = 1.5;  // places that are nearer are one, of the centre and at the ends of an oval
  double sure_step = 20.0;     // of grey values: what is stronger counts no more
  double edge_reach_mm = 2.5;  // of the search for the edge itself, about that place
  double scale_px = 4.0;       // Geman and McClure's, for its points
  int iterations = 15;         // of Levenberg and Marquardt, until the steps are small
  int outline_points = 160;    // 5 mm apart on the largest plates; half or twice costs a point (numbers.tsv)
  double min_step = 4.0;       // of grey values, across the rim
  double min_step_over_noise = 3.0;  // over the median magnitude of the steps beside the rim
  double min_support = 0.5;          // of the rim, along which there is such a step; less is no dish
};

inline constexpr std::size_t kBallotCells = 256;  // to a side of the votes: 1 m of table
// Along a profile across the rim, with the bands at either end and what rounding adds.
inline constexpr std::size_t kMaxRimOffsets = [] {
  constexpr DishSearchParams kUsual;
  return static_cast<std::size_t>(2.0 * (kUsual.vote_reach_mm + kUsual.band_mm) / kUsual.sample_mm) + 4;
}();

struct DishSearchView {
  FrameView frame;
  LensModel lens;
  Pose camera_from_table;
};
using DishSearchViews = std::array<DishSearchView, 2>;

struct FoundDish {
  int candidate = -1;
  DishPose place;
  double rms_mm = 0.0;   // of the rim's edge about the place
  double support = 0.0;  // share of the rim, in both views, along which there is an edge
  int inside_sign = 1;   // -1: darker than the table
};

// An edge on a level of the table frame: where, and the unit normal towards its brighter side.
struct RimLevelEdge {
  Vec2 place_mm = Vec2::Zero();
  Vec2 brighter = Vec2::Zero();
};

// A point of the outer edge, in the table frame, with the unit normal there that leads away from the dish.
struct RimNormal {
  Vec3 point_mm = Vec3::Zero();
  Vec3 outward = Vec3::Zero();

  Vec3 beyond(double mm) const { return point_mm + mm * outward; }
};

// How far a point of the rim moves outward, in samples, where the dish moves.
struct RimShift {
  float x = 0.0F;  // by a mm
  float y = 0.0F;
  float turn = 0.0F;  // by a rad
};

using RimEdges = std::array<BoundedList<RimEdge>, 2>;

struct DishSearchWorkspace {
  BoundedList<RimLevelEdge> level_edges;
  std::array<std::span<std::uint16_t>, 2> votes;  // for a dish brighter than the table, for a darker one
  std::span<Vec2> angles;                         // cosine and sine
  std::span<RimShift> shifts;                     // by angle
  std::span<float> steps;                         // over offsets from the rim, for each angle of both views
  std::array<BoundedList<Vec2>, 2> outlines;      // of the last trace
  std::array<BoundedList<Vec2>, 2> rims;          // of the dish that was sighted last

  template <class Allocator>
  constexpr void allocate(Allocator& arena, const DishSearchParams& params) {
    level_edges = BoundedList<RimLevelEdge>(
        arena.template take<RimLevelEdge>(2 * static_cast<std::size_t>(params.edges.max_edges)));
    for (std::span<std::uint16_t>& sheet : votes)
      sheet = arena.template take<std::uint16_t>(kBallotCells * kBallotCells);
    const auto points = static_cast<std::size_t>(params.outline_points);
    angles = arena.template take<Vec2>(points);
    shifts = arena.template take<RimShift>(points);
    steps = arena.template take<float>(2 * points * kMaxRimOffsets);
    for (auto* const lists : {&outlines, &rims}) {
      for (BoundedList<Vec2>& list : *lists) list = BoundedList<Vec2>(arena.template take<Vec2>(points));
    }
  }
};

// The best place for one of the candidates, apart from `taken`, by the edges of both views. rim_not_found
// where none has enough edge along its rim.
Result<FoundDish> search_dish(const DishSearchViews& views, const RimEdges& edges,
                              std::span<const DishModel> candidates, std::span<const FoundDish> taken,
                              const DishSearchParams& params, DishSearchWorkspace& workspace);

// Of the polygon that an ellipse is drawn as; it leaves a plate's by 0.02 mm.
inline constexpr std::size_t kRimCorners = 180;
using RimOutline = std::array<Vec2, kRimCorners>;

// A ring parallel to the rim, in pixels.
RimOutline rim_outline(const DishPose& place, const DishSearchView& camera, double beyond_mm,
                       double above_mm);

// The dish's outer edge at this angle from the first axis (of the ellipse's parameter).
RimNormal rim_normal(const DishPose& place, const Vec2& cosine_sine);

}  // namespace traygauge
