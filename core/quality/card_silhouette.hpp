// How much of the reference card is seen, by the shape of its label: something lies on it, or it is cut off,
// when the outline is no longer that of a whole card.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/base/arena.hpp"
#include "core/geometry/camera.hpp"
#include "core/geometry/geometry.hpp"
#include "core/image_view/image_view.hpp"
#include "core/labels/label_regions.hpp"

namespace traygauge {

// Plain numbers, so that what holds it can be planned at compile time.
struct SilhouetteCorner {
  double x_px = 0.0;
  double y_px = 0.0;
};

struct CardSilhouette {
  bool is_found = false;
  std::array<SilhouetteCorner, 4>
      corners;                   // of the least quadrilateral around the label, clockwise in the picture
  double filled_fraction = 0.0;  // of that quadrilateral's area that the label covers
  double aspect_ratio = 0.0;     // of the rectangle in space that looks like it; longer over shorter side
  double skew = 0.0;             // cosine between the sides of that rectangle; 0 is a right angle

  // Of a whole card of this aspect ratio, at most: a half that is covered along a straight line leaves a
  // quadrilateral, but a shorter, narrower or slanted one.
  double visible_fraction(double card_aspect_ratio) const;
};

struct CardSilhouetteWorkspace {
  std::span<Vec2> left;   // hull of the label's left side, downwards
  std::span<Vec2> right;  // … right side

  template <class Allocator>
  constexpr void allocate(Allocator& arena, int max_frame_height) {
    const auto points = 2 * static_cast<std::size_t>(max_frame_height);
    left = arena.template take<Vec2>(points);
    right = arena.template take<Vec2>(2 * points);  // … and then the whole hull
  }
};

// `box` holds every pixel of the card's label. Not found where the label has no quadrilateral around it.
CardSilhouette measure_card_silhouette(ImageView<const std::uint8_t> labels, const PixelBox& box,
                                       const LensModel& lens, CardSilhouetteWorkspace& workspace);

}  // namespace traygauge
