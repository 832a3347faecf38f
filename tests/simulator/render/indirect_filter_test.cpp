// What is smoothed, and what is kept apart.
#include "simulator/render/indirect_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace traygauge {
namespace {

// A table seen from straight above, 1 mm a pixel; a step or a fold along the middle as asked for.
struct Table {
  static constexpr int kSide = 40;

  Table() {
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const std::size_t at = map.index(x, y);
        map.points_mm[at] = Eigen::Vector3f(static_cast<float>(x), static_cast<float>(y), 0.0F);
        map.normals[at] = Eigen::Vector3f::UnitZ();
        map.objects[at] = 1;
        map.footprint_mm[at] = 1.0F;
        light.push_back(Eigen::Vector3f::Constant(is_right(x) ? 1.0F : 3.0F));
      }
    }
  }

  static bool is_right(int x) { return x >= kSide / 2; }

  template <class Change>
  void change_right(const Change& change) {
    for (int y = 0; y < kSide; ++y) {
      for (int x = kSide / 2; x < kSide; ++x) change(map.index(x, y));
    }
  }

  bool keeps_sides_apart() const {
    for (int x = 0; x < kSide; ++x) {
      if (std::abs(smooth_at(6.0F, x, 20).x() - (is_right(x) ? 1.0F : 3.0F)) > 1e-5F) return false;
    }
    return true;
  }

  Eigen::Vector3f smooth_at(float radius_px, int x, int y) const {
    return LightSmoother(map, light, radius_px, y, y + 1).at(x, y);
  }

  SurfaceMap map{kSide, kSide};
  std::vector<Eigen::Vector3f> light;
};

TEST(IndirectFilter, SmoothsWithinASurfaceOnly) {
  Table table;
  EXPECT_FALSE(table.keeps_sides_apart());
  table.change_right([&](std::size_t i) { table.map.objects[i] = 2; });
  EXPECT_TRUE(table.keeps_sides_apart()) << "another object";
  Table step;
  step.change_right([&](std::size_t i) { step.map.points_mm[i].z() = 5.0F; });
  EXPECT_TRUE(step.keeps_sides_apart()) << "a step";
  Table fold;
  fold.change_right(
      [&](std::size_t i) { fold.map.normals[i] = Eigen::Vector3f(0.5F, 0.0F, 0.87F).normalized(); });
  EXPECT_TRUE(fold.keeps_sides_apart()) << "a fold";
}

TEST(IndirectFilter, LeavesMixedPixelsAndNoiseWithoutRadiusAsTheyAre) {
  Table table;
  table.change_right([&](std::size_t i) { table.map.is_mixed[i] = 1; });
  EXPECT_TRUE(table.keeps_sides_apart());
  const Table plain;
  EXPECT_EQ(plain.smooth_at(0.0F, 19, 20), plain.light[plain.map.index(19, 20)]);
}

TEST(IndirectFilter, KnowsEdges) {
  const auto edge_columns = [](const Table& table, int reach_px) {
    std::vector<int> columns;
    for (int x = 0; x < Table::kSide; ++x) {
      if (is_near_edge(table.map, reach_px, x, 20)) columns.push_back(x);
    }
    return columns;
  };
  Table table;
  EXPECT_TRUE(edge_columns(table, 3).empty());
  table.change_right([&](std::size_t i) { table.map.objects[i] = 2; });
  EXPECT_EQ(edge_columns(table, 1), (std::vector<int>{19, 20}));
  EXPECT_EQ(edge_columns(table, 2), (std::vector<int>{18, 19, 20, 21}));
  Table step;
  step.change_right([&](std::size_t i) { step.map.points_mm[i].z() = 5.0F; });
  EXPECT_EQ(edge_columns(step, 1), (std::vector<int>{19, 20}));
  Table fold;
  fold.change_right(
      [&](std::size_t i) { fold.map.normals[i] = Eigen::Vector3f(0.0F, 0.7F, 0.7F).normalized(); });
  EXPECT_EQ(edge_columns(fold, 1), (std::vector<int>{19, 20}));
}

// A bell (1 - r²)² over the disc: (∫ w)² / ∫ w² is 5π/9 R² pixels.
TEST(IndirectFilter, NoiseFallsWithTheWindow) {
  Table table;
  std::mt19937 random(11);
  std::normal_distribution<float> noise(2.0F, 1.0F);
  double square = 0.0;
  int count = 0;
  for (int trial = 0; trial < 200; ++trial) {
    for (Eigen::Vector3f& value : table.light) value.setConstant(noise(random));
    for (const int place : {10, 30}) {
      const auto off = static_cast<double>(table.smooth_at(6.0F, place, place).x()) - 2.0;
      square += off * off;
      ++count;
    }
  }
  const double pixels = 5.0 * 3.14159 / 9.0 * 36.0;
  EXPECT_NEAR(square / count * pixels, 1.0, 0.25);
}

}  // namespace
}  // namespace traygauge
