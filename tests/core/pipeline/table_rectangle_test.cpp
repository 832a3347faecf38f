// Rectangles of the table that are joined where they are near each other.
#include "core/pipeline/table_rectangle.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <random>
#include <span>
#include <vector>

#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

constexpr double kNearMm = 20.0;

TableRectangle place_at(double x_mm, double y_mm, double side_mm) {
  return {{x_mm, y_mm}, {x_mm + side_mm, y_mm + side_mm}};
}

bool are_near(const TableRectangle& a, const TableRectangle& b) {
  return !a.grown(kNearMm).shared_with(b).empty();
}

TEST(TableRectangle, AChainOfNearPlacesIsOne) {
  std::array places = {place_at(0, 0, 30), place_at(200, 0, 30), place_at(90, 0, 30), place_at(45, 0, 30)};
  std::array<std::size_t, 4> joined;
  ASSERT_EQ(join_near(places, kNearMm, joined), 2U);
  EXPECT_EQ(joined[0], joined[2]);
  EXPECT_EQ(joined[0], joined[3]);
  EXPECT_NE(joined[0], joined[1]);
  EXPECT_EQ(places[joined[0]].size_mm(), Vec2(120.0, 30.0));
  EXPECT_EQ(places[joined[1]].size_mm(), Vec2(30.0, 30.0));
}

TEST(TableRectangle, JoinedPlacesHoldTheirOwnAndLieApart) {
  std::mt19937 random(test::random_seed());
  std::uniform_real_distribution<double> along_mm(0.0, 500.0);
  std::uniform_real_distribution<double> side_mm(5.0, 60.0);
  int joined_ones = 0;
  for (int round = 0; round < 200; ++round) {
    std::vector<TableRectangle> before;
    for (int i = 0; i < 1 + round % 12; ++i)
      before.push_back(place_at(along_mm(random), along_mm(random), side_mm(random)));
    std::vector<TableRectangle> places = before;
    std::vector<std::size_t> joined(places.size());
    const std::size_t count = join_near(places, kNearMm, joined);
    std::vector<TableRectangle> around(count);
    for (std::size_t i = 0; i < before.size(); ++i) {
      ASSERT_LT(joined[i], count);
      around[joined[i]].include(before[i]);
    }
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_EQ(places[i].least_mm, around[i].least_mm);
      EXPECT_EQ(places[i].most_mm, around[i].most_mm);
      for (std::size_t j = i + 1; j < count; ++j) EXPECT_FALSE(are_near(places[i], places[j]));
    }
    bool is_any_near = false;
    for (std::size_t i = 0; i < before.size(); ++i) {
      for (std::size_t j = i + 1; j < before.size(); ++j) is_any_near |= are_near(before[i], before[j]);
    }
    EXPECT_EQ(count < before.size(), is_any_near);
    joined_ones += is_any_near ? 1 : 0;
  }
  EXPECT_GT(joined_ones, 50);
}

}  // namespace
}  // namespace traygauge
