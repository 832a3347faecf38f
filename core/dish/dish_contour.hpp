// The dish's border in a label picture, between the pixels.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/base/arena.hpp"
#include "core/base/bounded_list.hpp"
#include "core/base/status.hpp"
#include "core/geometry/geometry.hpp"
#include "core/image_view/image_view.hpp"
#include "core/labels/label_set.hpp"

namespace traygauge {

// The middle of the side that a dish pixel shares with a pixel outside.
struct BorderSide {
  float x_px = 0.0F;
  float y_px = 0.0F;
  bool against_table = false;  // false where the card, another dish or the picture's edge bounds the dish
  std::uint8_t label = 0;      // of the dish pixel: the dish itself, or food that hides its rim
};

// Closed and in order, clockwise in the picture, so the dish lies on the right of the walk.
struct DishContour {
  BoundedList<BorderSide> sides;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, std::size_t max_sides) {
    sides = BoundedList<BorderSide>(arena.template take<BorderSide>(max_sides));
  }
  Vec2 place(std::size_t index) const { return {sides[index].x_px, sides[index].y_px}; }
};

// Walks around the region of `on_dish` that makes up most of its pixels; specks and holes are passed over. Of
// every so many rows and columns one is searched for the region. no_dish_label without such a region,
// out_of_memory when it has more sides than the list holds.
Status trace_dish_contour(ImageView<const std::uint8_t> labels, const LabelSet& on_dish, int search_step,
                          DishContour& contour);

// The same for the only dish, labels 1…199.
Status trace_dish_contour(ImageView<const std::uint8_t> labels, DishContour& contour);

// Half or twice of either number changes no volume of six pairs of the captures
// (tests/evaluation/numbers.tsv).
struct ContourFitParams {
  // Sides on each side of a place that its curve is fitted to: fewer let the pixel grid through, more cut
  // corners at notches.
  int radius_sides = 16;
  double max_rms_px = 1.0;  // of the sides about the curve; a smooth border's own grid noise is 0.3 to 0.4
};

// The border near one side as a parabola: origin + u tangent + (a + b u + c u²) inward.
struct ContourCurve {
  Vec2 origin = Vec2::Zero();
  Vec2 tangent = Vec2::Zero();  // along the walk
  Vec2 inward = Vec2::Zero();
  Vec3 coefficients = Vec3::Zero();
  double rms_px = 0.0;

  Vec2 point(double u) const {
    return origin + u * tangent + (coefficients[0] + u * (coefficients[1] + u * coefficients[2])) * inward;
  }
  Vec2 direction(double u) const {
    return (tangent + (coefficients[1] + 2.0 * u * coefficients[2]) * inward).normalized();
  }
};

// Least-squares parabola over the neighbours of side `index`. False where any of them is not against the
// table, the contour is too short, or the border is not smooth there.
bool fit_contour_curve(const DishContour& contour, std::size_t index, const ContourFitParams& params,
                       ContourCurve& curve);

}  // namespace traygauge
