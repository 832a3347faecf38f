// The card's outline in the label picture, as four straight sides.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/base/arena.hpp"
#include "core/base/result.hpp"
#include "core/geometry/camera.hpp"
#include "core/geometry/geometry.hpp"
#include "core/labels/label_regions.hpp"

namespace traygauge {

// Half or twice of any number here moves the MAPE of six pairs of the captures by 0.01 points at most
// (tests/evaluation/numbers.tsv).
struct CardOutlineParams {
  int max_points = 2048;          // of the outline, two a row and two a column; more rows are skipped
  int min_side_px = 16;           // of the labelled box; less shows no print
  double near_px = 2.5;           // points that may belong to a side: labels are true to a pixel or two
  double inlier_px = 0.7;         // of Cauchy's weights, with which a side is fitted
  double corner_fraction = 0.05;  // of a side, left out at both ends: labels are round there
};

struct CardOutline {
  std::array<Vec2, 4> corners;      // rays, clockwise in the picture; side i leads from corner i to i + 1
  std::array<double, 4> support{};  // share of each side along which labels end
};

struct CardOutlineWorkspace {
  std::span<Vec2> points;
  std::span<Vec2> sorted;
  std::span<Vec2> hull;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, const CardOutlineParams& params) {
    const auto count = static_cast<std::size_t>(params.max_points);
    points = arena.template take<Vec2>(count);
    sorted = arena.template take<Vec2>(count);
    hull = arena.template take<Vec2>(count + 1);
  }
};

// The convex hull of the label, its sides removed one by one, always the one that adds the least area when
// its neighbours are extended, until four are left: a covered corner or a fork across the card then changes
// nothing. Each side is fitted anew to the points near it. In rays, where sides are straight. card_not_found
// when the label is missing, small, or has no such quadrilateral. O(points · log points + hull²).
Result<CardOutline> find_card_outline(ImageView<const std::uint8_t> labels, const PixelBox& box,
                                      const LensModel& lens, const CardOutlineParams& params,
                                      CardOutlineWorkspace& workspace);

}  // namespace traygauge
