// What the rim of a dish that was found says of its size: the second ruler beside the card.
#include <gtest/gtest.h>

#include "tests/core/dish/drawn_table.hpp"

namespace traygauge {
namespace {

using test::dish_of;
using test::DrawnTable;
using test::place_of;

// As a card shows it that is stated too large by as much.
std::array<DishSighting, 2> sightings_of(const DishModel& described, double size, double azimuth_rad) {
  const DishModel drawn =
      dish_of(size * described.outer_size_mm[0], size * described.outer_size_mm[1], described.rim_height_mm);
  DrawnTable table({place_of(drawn, {10.0, -15.0}, azimuth_rad)});
  const Result<FoundDish> found = table.search({&described, 1}, {});
  EXPECT_TRUE(found.ok()) << size;
  return found.ok() ? table.sight(*found) : std::array<DishSighting, 2>{};
}

// From 4 % on the band that is drawn inside the edge lies where the edge is described, and is found instead.
TEST(FoundDishSighting, SaysHowMuchLargerTheDishLooks) {
  for (const DishModel& dish :
       {dish_of(240.0, 240.0, 25.0), dish_of(160.0, 160.0, 40.0), dish_of(260.0, 180.0, 22.0)}) {
    for (const double size : {1.0, 1.01, 1.02, 1.03}) {
      for (const DishSighting& sighting : sightings_of(dish, size, 0.6)) {
        ASSERT_TRUE(sighting.is_known) << dish.outer_size_mm[0] << " " << size;
        EXPECT_NEAR(sighting.place[kSightedSize], size - 1.0, 0.003) << dish.outer_size_mm[0];
        EXPECT_LT((sighting.place.head<2>() - Vec2(10.0, -15.0)).norm(), 0.7);
      }
    }
  }
}

// The places are those of the edge that is drawn, not of a rim as it is described.
TEST(FoundDishSighting, LeavesTheEdgeThatItSaw) {
  const DishModel described = dish_of(240.0, 240.0, 25.0);
  for (const double size : {1.0, 1.02}) {
    const DishPose drawn =
        place_of(dish_of(size * 240.0, size * 240.0, described.rim_height_mm), {10.0, -15.0}, 0.0);
    DrawnTable table({drawn});
    const Result<FoundDish> found = table.search({&described, 1}, {});
    ASSERT_TRUE(found.ok());
    table.sight(*found);
    for (std::size_t v = 0; v < 2; ++v) {
      const DishSearchView& view = table.view(v);
      const RimProjection rim(drawn, view.camera_from_table, view.lens.pinhole.mean_focal_px());
      int near = 0;
      for (const Vec2& ray : table.rim(v)) {
        double residual_px = 0.0;
        ASSERT_TRUE(rim.residual(ray, residual_px));
        near += std::abs(residual_px) < 0.7 ? 1 : 0;
      }
      EXPECT_GT(table.rim(v).size(), 100U) << size;
      EXPECT_GT(near, 0.92 * static_cast<double>(table.rim(v).size())) << size;
    }
  }
}

// The drawn dish has a band inside its edge, which a smaller rim would be taken for.
TEST(FoundDishSighting, SaysNothingWrongOfADishThatLooksSmaller) {
  for (const double size : {0.97, 0.98, 0.99}) {
    for (const DishSighting& sighting : sightings_of(dish_of(240.0, 240.0, 25.0), size, 0.0)) {
      if (sighting.is_known) {
        EXPECT_NEAR(sighting.place[kSightedSize], size - 1.0, 0.003);
      }
    }
  }
}

}  // namespace
}  // namespace traygauge
