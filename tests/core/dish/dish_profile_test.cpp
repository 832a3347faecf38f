// The dish's inner surface against SciPy: PchipInterpolator for the profile, brentq for the inset.
#include "core/dish/dish_profile.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <utility>
#include <vector>

namespace traygauge {
namespace {

DishModel model_of(std::array<double, 2> size_mm, const std::vector<std::pair<double, double>>& profile) {
  DishModel model;
  model.outer_size_mm = size_mm;
  for (const auto& [inset, height] : profile) model.profile_points[model.profile_size++] = {inset, height};
  model.bottom_height_mm = profile.empty() ? 4.0 : profile.back().second;
  model.rim_height_mm = 24.0;
  return model;
}

const std::vector<std::pair<double, double>> kDinner = {{0, 21.4},  {1.6, 22.0}, {4.5, 21.4}, {28, 15.5},
                                                        {36, 11.0}, {43, 6.6},   {49, 4.5}};
const std::vector<std::pair<double, double>> kBowl = {
    {0, 54.2},       {1.5, 55.0},    {2.8, 54.1},    {4.2, 51.5},    {8.12, 38.782}, {13.02, 28.955},
    {19.88, 19.749}, {28.7, 12.147}, {37.52, 7.642}, {45.36, 5.586}, {53.2, 5.0}};
const std::vector<std::pair<double, double>> kOval = {{0, 23.4},  {1.6, 24.0}, {4.5, 23.5}, {19, 18.6},
                                                      {26, 12.4}, {32, 7.0},   {38, 4.0}};

void expect_heights(const DishModel& model, const std::vector<std::pair<double, double>>& expected) {
  DishProfile profile;
  ASSERT_TRUE(profile.set(model).ok());
  for (const auto& [inset, height] : expected) {
    EXPECT_NEAR(profile.height_at_inset_mm(inset), height, 1e-9) << "at inset " << inset;
  }
}

TEST(DishProfile, IsThePchipOfItsPoints) {
  expect_heights(model_of({260, 260}, kDinner), {{0.00, 21.400000000000},
                                                 {0.70, 21.772923962823},
                                                 {1.55, 21.999159609038},
                                                 {2.10, 21.968430865827},
                                                 {4.45, 21.411215619714},
                                                 {5.00, 21.289966752482},
                                                 {12.50, 19.709497559838},
                                                 {27.30, 15.755000068115},
                                                 {31.70, 13.653437390566},
                                                 {40.20, 8.199286888066},
                                                 {48.90, 4.522409906257}});
  expect_heights(model_of({152, 152}, kBowl), {{0.70, 54.796986894587},
                                               {1.55, 54.997962921398},
                                               {2.10, 54.751374951932},
                                               {4.45, 50.892434117852},
                                               {12.50, 29.815714267799},
                                               {27.30, 13.098314197053},
                                               {48.90, 5.211588657418}});
}

TEST(DishProfile, OfTwoOrThreePointsIsScipysToo) {
  expect_heights(model_of({100, 100}, {{0, 10}, {20, 4}}), {{5.0, 8.5}});
  expect_heights(
      model_of({100, 100}, {{0, 10}, {5, 9}, {6, 4}}),
      {{1.0, 9.973419354839}, {4.5, 9.223967741935}, {5.2, 8.603664516129}, {5.9, 4.605445161290}});
}

TEST(DishProfile, InsetOfAnOvalSolvesItsEquation) {
  DishProfile profile;
  ASSERT_TRUE(profile.set(model_of({300, 210}, kOval)).ok());
  struct Case {
    double x, y, inset, height;
  };
  for (const Case& c :
       {Case{149, 0, 1.0, 23.890261314655}, Case{0, -104, 1.0, 23.890261314655},
        Case{120, 40, 15.759693329744, 20.113334031321}, Case{-100, -70, 7.044864035356, 22.921771678490},
        Case{80, 75, 12.712172812153, 21.277102460618}, Case{10, 90, 14.752974241114, 20.523391801844},
        Case{141.3, 5, 8.509908613163, 22.550079136455}, Case{112.5, 0.01, 37.499998765432, 4.160516294827},
        Case{60, 99, -2.663738689576, 23.4}}) {
    EXPECT_NEAR(profile.inset_mm({c.x, c.y}), c.inset, 1e-6) << c.x << " " << c.y;
    EXPECT_NEAR(profile.height_mm({c.x, c.y}), c.height, 1e-6) << c.x << " " << c.y;
  }
  EXPECT_EQ(profile.height_mm({0, 0}), 4.0);
  EXPECT_EQ(profile.height_mm({111.9, 0}), 4.0);
}

TEST(DishProfile, RoundAndNearlyRoundDishesAgree) {
  DishProfile round;
  DishProfile nearly;
  ASSERT_TRUE(round.set(model_of({260, 260}, kDinner)).ok());
  ASSERT_TRUE(nearly.set(model_of({260, 260.000001}, kDinner)).ok());
  for (double r = 0.0; r < 135.0; r += 0.7) {
    const Vec2 at(r * 0.8, r * 0.6);
    EXPECT_NEAR(round.height_mm(at), nearly.height_mm(at), 1e-5) << r;
  }
}

TEST(DishProfile, FollowsWhereTheDishStands) {
  InnerSurface dish;
  ASSERT_TRUE(dish.profile.set(model_of({300, 210}, kOval)).ok());
  dish.place = {{40, -30}, {0.6, 0.8}};
  const Vec2 local(120, 40);
  const Vec2 at = dish.place.centre_mm + local.x() * Vec2(0.6, 0.8) + local.y() * Vec2(-0.8, 0.6);
  EXPECT_NEAR((dish.to_dish(at) - local).norm(), 0.0, 1e-12);
  EXPECT_NEAR(dish.height_mm(at), 20.113334031321, 1e-6);
}

TEST(DishProfile, WithoutProfileIsFlat) {
  DishProfile profile;
  ASSERT_TRUE(profile.set(model_of({300, 210}, {})).ok());
  EXPECT_EQ(profile.height_mm({0, 0}), 4.0);
  EXPECT_EQ(profile.height_mm({140, 10}), 4.0);
}

TEST(DishProfile, RefusesWhatIsNoDish) {
  DishProfile profile;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(profile.set(model_of({0, 100}, {})).code(), StatusCode::invalid_configuration);
  EXPECT_EQ(profile.set(model_of({100, nan}, {})).code(), StatusCode::invalid_configuration);
  EXPECT_EQ(profile.set(model_of({100, 100}, {{0, 5}, {0, 4}})).code(), StatusCode::invalid_configuration);
  EXPECT_EQ(profile.set(model_of({100, 100}, {{-1, 5}, {2, 4}})).code(), StatusCode::invalid_configuration);
  EXPECT_EQ(profile.set(model_of({100, 80}, {{0, 5}, {40, 4}})).code(), StatusCode::invalid_configuration);
  EXPECT_EQ(profile.set(model_of({100, 80}, {{0, nan}, {4, 4}})).code(), StatusCode::invalid_configuration);
}

}  // namespace
}  // namespace traygauge
