#include "core/dish/dish_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "tests/core/dish/drawn_table.hpp"

namespace traygauge {
namespace {

using test::dish_of;
using test::DrawnTable;
using test::place_of;

TEST(DishSearch, FindsARoundDishByItsRim) {
  const DishModel dish = dish_of(240.0, 240.0, 25.0);
  for (std::uint32_t seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE(seed);
    const Vec2 centre_mm(-20.0 + 15.0 * seed, 12.0 * seed - 25.0);
    DrawnTable table({place_of(dish, centre_mm, 0.0)}, seed);
    const Result<FoundDish> found = table.search({&dish, 1}, {});
    ASSERT_TRUE(found.ok());
    EXPECT_LT((found->place.centre_mm - centre_mm).norm(), 0.5);
    EXPECT_GT(found->support, 0.95);
  }
}

TEST(DishSearch, FindsAnOvalDishAndHowItIsTurned) {
  const DishModel dish = dish_of(260.0, 180.0, 22.0);
  for (const double azimuth_rad : {0.1, 1.0, 2.2}) {
    SCOPED_TRACE(azimuth_rad);
    DrawnTable table({place_of(dish, {10.0, -15.0}, azimuth_rad)});
    const Result<FoundDish> found = table.search({&dish, 1}, {});
    ASSERT_TRUE(found.ok());
    EXPECT_LT((found->place.centre_mm - Vec2(10.0, -15.0)).norm(), 0.6);
    EXPECT_LT(std::abs(std::remainder(found->place.azimuth_rad - azimuth_rad, std::numbers::pi)), 0.01);
  }
}

TEST(DishSearch, ChoosesTheDishByItsSize) {
  const std::vector<DishModel> candidates = {dish_of(200.0, 200.0, 25.0), dish_of(230.0, 230.0, 25.0),
                                             dish_of(260.0, 180.0, 22.0)};
  DrawnTable table({place_of(candidates[1], {5.0, 8.0}, 0.0)});
  const Result<FoundDish> found = table.search(candidates, {});
  ASSERT_TRUE(found.ok());
  EXPECT_EQ(found->candidate, 1);
}

TEST(DishSearch, TakesOnePlaceOnceOnly) {
  const DishModel dish = dish_of(150.0, 150.0, 30.0);
  const Vec2 first_mm(-90.0, 0.0);
  const Vec2 second_mm(85.0, 10.0);
  DrawnTable table({place_of(dish, first_mm, 0.0), place_of(dish, second_mm, 0.0)});
  const Result<FoundDish> one = table.search({&dish, 1}, {});
  ASSERT_TRUE(one.ok());
  const Result<FoundDish> other = table.search({&dish, 1}, {&*one, 1});
  ASSERT_TRUE(other.ok());
  const bool is_first = (one->place.centre_mm - first_mm).norm() < 0.5;
  EXPECT_LT((one->place.centre_mm - (is_first ? first_mm : second_mm)).norm(), 0.5);
  EXPECT_LT((other->place.centre_mm - (is_first ? second_mm : first_mm)).norm(), 0.5);
}

TEST(DishSearch, FindsNoDishOnABareTable) {
  const DishModel dish = dish_of(240.0, 240.0, 25.0);
  DrawnTable table({});
  EXPECT_EQ(table.search({&dish, 1}, {}).code(), StatusCode::rim_not_found);
}

}  // namespace
}  // namespace traygauge
