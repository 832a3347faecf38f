#include "core/dish/dish_model.hpp"

#include <gtest/gtest.h>

#include <initializer_list>
#include <limits>
#include <vector>

namespace traygauge {
namespace {

const double kNan = std::numeric_limits<double>::quiet_NaN();
const double kInfinity = std::numeric_limits<double>::infinity();

DishModel dish_with(std::initializer_list<DishProfilePoint> profile) {
  DishModel dish{{260.0, 200.0}, 22.0, 4.5};
  for (const DishProfilePoint& point : profile) dish.profile_points[dish.profile_size++] = point;
  return dish;
}

TEST(DishModel, TakesAProfileFromTheEdgeToTheMiddle) {
  EXPECT_TRUE(validate(dish_with({})).ok());
  EXPECT_TRUE(validate(dish_with({{0.0, 21.4}, {1.6, 22.0}, {100.0, 4.5}})).ok());
  DishModel full = dish_with({});
  while (full.profile_size < kMaxDishProfilePoints) {
    full.profile_points[full.profile_size] = {static_cast<double>(full.profile_size), 10.0};
    ++full.profile_size;
  }
  EXPECT_TRUE(validate(full).ok());
  ++full.profile_size;
  EXPECT_EQ(validate(full).code(), StatusCode::invalid_configuration) << "would be read beyond its end";
}

TEST(DishModel, RefusesProfilesThatAreNone) {
  for (const DishModel& dish :
       {dish_with({{0.0, 22.0}}), dish_with({{0.0, 22.0}, {0.0, 4.5}}), dish_with({{5.0, 22.0}, {4.0, 4.5}}),
        dish_with({{-1.0, 22.0}, {4.0, 4.5}}), dish_with({{0.0, 22.0}, {100.1, 4.5}}),
        dish_with({{0.0, 22.0}, {kNan, 4.5}}), dish_with({{kNan, 22.0}, {4.0, 4.5}}),
        dish_with({{0.0, kNan}, {4.0, 4.5}}), dish_with({{0.0, 22.0}, {4.0, kInfinity}}),
        dish_with({{0.0, 22.0}, {4.0, -0.1}}), dish_with({{0.0, 201.0}, {4.0, 4.5}})}) {
    EXPECT_EQ(validate(dish).code(), StatusCode::invalid_configuration)
        << dish.profile_points[0].inset_mm << " " << dish.profile_points[1].height_mm;
  }
}

Status validate_labels(std::initializer_list<int> labels) {
  std::vector<DishModel> dishes;
  for (const int label : labels) {
    dishes.push_back(dish_with({}));
    dishes.back().label = static_cast<std::uint8_t>(label);
  }
  return validate(dishes);
}

TEST(DishModel, DishesOfATrayHaveLabelsOfTheirOwn) {
  EXPECT_TRUE(validate_labels({1}).ok());
  EXPECT_TRUE(validate_labels({1, 1, 1}).ok()) << "candidates for the only dish";
  EXPECT_TRUE(validate_labels({1, 201, 249}).ok());
  EXPECT_TRUE(validate_labels({202, 201}).ok());
  for (const auto labels : {std::initializer_list<int>{1, 201, 201},
                            {1, 1, 201},
                            {201, 201},
                            {0},
                            {2},
                            {199},
                            {200},
                            {250},
                            {255}}) {
    EXPECT_EQ(validate_labels(labels).code(), StatusCode::invalid_configuration) << *labels.begin();
  }
}

}  // namespace
}  // namespace traygauge
