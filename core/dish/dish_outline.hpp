// A dish's outline in a stored label picture, as rays.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/base/bounded_list.hpp"
#include "core/base/status.hpp"
#include "core/dish/dish_contour.hpp"
#include "core/geometry/camera.hpp"
#include "core/geometry/geometry.hpp"
#include "core/image_view/image_view.hpp"
#include "core/labels/label_set.hpp"

namespace traygauge {

// Half or twice of any number here moves the MAPE of six pairs of the captures by 0.02 points at most
// (tests/evaluation/numbers.tsv).
struct DishOutlineParams {
  // So many consecutive sides give one point, their mean. The sides of a staircase lie about the border
  // without bias; over 8 sides an arc of 50 px radius is off by 0.05 px, and half a pixel of grid noise is
  // left at most.
  int block_sides = 8;
  int search_step = 4;  // px between the rows, and columns, that are searched for the dish
};

// The same in a picture that nobody labelled: the edge that it shows along the rim of a dish that was found.
struct SeenRim {
  std::uint8_t label = kBackgroundLabel;  // where no single edge shows
  BoundedList<Vec2> rays;
};

struct DishOutlineWorkspace {
  DishContour contour;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, std::size_t max_sides) {
    contour.allocate(arena, max_sides);
  }
};

// The dish with what lies on it.
struct DishRegion {
  std::uint8_t dish = kDishLabel;
  LabelSet on_dish = labels_of_single_dish();
};

// Rays (z = 1) of the places where the dish itself, not its food, borders on background; in order around the
// dish. no_dish_label and out_of_memory from the tracing; points beyond the list's capacity are dropped.
Status trace_dish_outline(ImageView<const std::uint8_t> labels, const LensModel& lens,
                          const DishRegion& region, const DishOutlineParams& params,
                          DishOutlineWorkspace& workspace, BoundedList<Vec2>& rays);

}  // namespace traygauge
