#include "simulator/scenes/tray_sets.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "simulator/scenes/dish_shell.hpp"
#include "simulator/scenes/scene_poses.hpp"
#include "simulator/scenes/scene_sets.hpp"
#include "simulator/scenes/scene_views.hpp"

namespace traygauge {
namespace {

constexpr std::uint64_t kTraySeed = 1;

TEST(TraySets, TraysHoldTheirDishesApart) {
  for (const char* name : {"trays-8", "moved-4", "beside-8", "station-40"}) {
    for (const SceneDescription& scene : make_scenes(name, kTraySeed, SetSize::full)) {
      EXPECT_GE(scene.dishes.size(), 2U);
      for (std::size_t i = 0; i < scene.dishes.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
          const DishShell shell(scene.dishes[k].dish);
          const Eigen::Isometry3d to_other =
              world_from_dish(scene.dishes[k]).inverse() * world_from_dish(scene.dishes[i]);
          for (double angle = 0.0; angle < 6.28; angle += 0.1) {
            const Eigen::Vector3d at =
                to_other * Eigen::Vector3d(0.5 * scene.dishes[i].dish.outer_size_mm[0] * std::cos(angle),
                                           0.5 * scene.dishes[i].dish.outer_size_mm[1] * std::sin(angle),
                                           0.0);
            EXPECT_FALSE(shell.contains(at.x(), at.y(), 0.0)) << scene.name;
          }
        }
      }
    }
  }
}

TEST(TraySets, AStationKeepsCameraDishesAndPlacesFromTrayToTray) {
  for (std::uint64_t seed = kTraySeed; seed < kTraySeed + 10; ++seed) {
    const auto scenes = make_scenes("station-40", seed, SetSize::full);
    ASSERT_EQ(scenes.size(), 40U) << seed;
    const SceneDescription& first = scenes.front();
    std::set<std::vector<std::string>> meals;
    for (const SceneDescription& scene : scenes) {
      EXPECT_EQ(scene.dishes.size(), first.dishes.size()) << scene.name;
      EXPECT_EQ(scene.dishes.back().centre_mm, first.dishes.back().centre_mm) << scene.name;
      ASSERT_EQ(scene.views.size(), 2U) << scene.name;
      for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(scene.views[i].azimuth_deg, first.views[i].azimuth_deg) << scene.name;
        EXPECT_TRUE(is_all_in_picture(scene, scene.views[i])) << scene.name << ", seed " << seed;
        EXPECT_EQ(scene.views[i].tray_shift_mm, scene.views[0].tray_shift_mm) << scene.name;
      }
      std::vector<std::string> foods;
      for (const LaidFood& food : scene.foods) foods.push_back(food.name);
      meals.insert(foods);
    }
    EXPECT_GT(meals.size(), 35U) << seed;
  }
}

}  // namespace
}  // namespace traygauge
