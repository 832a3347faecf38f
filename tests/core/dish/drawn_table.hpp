// Dishes drawn by intersecting every pixel's ray with the plane of their edge: where they stand is known.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "core/dish/dish_search.hpp"
#include "core/dish/dish_sighting.hpp"
#include "tests/support/allocated.hpp"
#include "tests/support/cameras.hpp"

namespace traygauge::test {

inline DishModel dish_of(double length_mm, double width_mm, double height_mm) {
  DishModel dish;
  dish.outer_size_mm = {length_mm, width_mm};
  dish.rim_height_mm = height_mm;
  dish.bottom_height_mm = 4.0;
  return dish;
}

inline DishPose place_of(const DishModel& dish, const Vec2& centre_mm, double azimuth_rad) {
  return {centre_mm, azimuth_rad, dish.rim_height_mm, dish.outer_size_mm, 0.0};
}

// A grained table under two cameras, with dishes on it.
class DrawnTable {
 public:
  static constexpr int kWidth = 800;
  static constexpr int kHeight = 600;

  explicit DrawnTable(const std::vector<DishPose>& dishes, std::uint32_t seed = 1) {
    const LensModel lens{kWidth, kHeight, {700.0, 700.0, 405.0, 297.0}, -0.05, 0.01, 0.0, 0.0, 0.0};
    for (std::size_t v = 0; v < 2; ++v) {
      DishSearchView& view = views_[v];
      view.lens = lens;
      view.camera_from_table = camera_above(v == 0 ? 0.15 : 0.35, v == 0 ? 0.3 : 2.0, 520.0);
      std::mt19937 random(seed + static_cast<std::uint32_t>(v));
      std::uniform_int_distribution<int> grain(-25, 25);
      pixels_[v].resize(std::size_t{kWidth} * kHeight);
      for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
          Vec2 ray;
          EXPECT_TRUE(lens.undistort_pixel({static_cast<double>(x), static_cast<double>(y)}, ray));
          int gray = 90 + grain(random);
          for (const DishPose& dish : dishes) gray = draw(view.camera_from_table, dish, ray, gray);
          pixels_[v][static_cast<std::size_t>(y * kWidth + x)] = static_cast<std::uint8_t>(gray);
        }
      }
      view.frame = {pixels_[v].data(), kWidth, kHeight, kWidth, PixelFormat::gray8};
      collect_rim_edges({pixels_[v].data(), kWidth, kHeight}, lens, params_.edges, *edge_memory_, edges_[v]);
    }
  }

  Result<FoundDish> search(std::span<const DishModel> candidates, std::span<const FoundDish> taken) {
    return search_dish(views_, edges_, candidates, taken, params_, *memory_);
  }
  std::array<DishSighting, 2> sight(const FoundDish& found) {
    return sight_found_dish(views_, found, params_, DishSightingParams{}, *memory_);
  }
  // Of the dish that was sighted last.
  std::span<const Vec2> rim(std::size_t view) { return (*memory_).rims[view].items(); }
  const DishSearchView& view(std::size_t index) const { return views_[index]; }

 private:
  // White, with a dark band 6 to 9 mm inside the edge.
  static int draw(const Pose& camera_from_table, const DishPose& dish, const Vec2& ray, int behind) {
    const Pose table_from_camera = camera_from_table.inverse();
    const Vec3 direction = table_from_camera.rotation * ray.homogeneous();
    const double depth = (dish.edge_height_mm - table_from_camera.translation.z()) / direction.z();
    const Vec2 offset = (table_from_camera.translation + depth * direction).head<2>() - dish.centre_mm;
    const double c = std::cos(dish.azimuth_rad);
    const double s = std::sin(dish.azimuth_rad);
    const Vec2 on_axes(c * offset.x() + s * offset.y(), c * offset.y() - s * offset.x());
    const auto is_within = [&](double inset_mm) {
      return Vec2(on_axes.x() / (0.5 * dish.size_mm[0] - inset_mm),
                  on_axes.y() / (0.5 * dish.size_mm[1] - inset_mm))
                 .norm() < 1.0;
    };
    if (!is_within(0.0)) return behind;
    return is_within(6.0) && !is_within(9.0) ? 70 : 205;
  }

  DishSearchParams params_;
  test::Allocated<RimEdgeWorkspace> edge_memory_{RimEdgeParams{}};
  test::Allocated<DishSearchWorkspace> memory_{DishSearchParams{}};
  std::array<std::vector<RimEdge>, 2> edge_storage_{std::vector<RimEdge>(4000), std::vector<RimEdge>(4000)};
  RimEdges edges_{BoundedList<RimEdge>(edge_storage_[0]), BoundedList<RimEdge>(edge_storage_[1])};
  DishSearchViews views_;
  std::array<std::vector<std::uint8_t>, 2> pixels_;
};

}  // namespace traygauge::test
