#include "simulator/scenes/laid_body.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "simulator/bodies/proof_body.hpp"
#include "simulator/scenes/mesh_tools.hpp"
#include "simulator/scenes/scene_digest.hpp"
#include "simulator/scenes/scene_file.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"

namespace traygauge {
namespace {

// 160 mm flat, 4 mm above the table.
DishDescription flat_dish() {
  DishDescription dish;
  dish.outer_size_mm = {240.0, 240.0};
  dish.rim_height_mm = 20.0;
  dish.bottom_height_mm = 4.0;
  dish.profile = {{0.0, 20.0}, {40.0, 4.0}};
  return dish;
}

SceneDescription scene_with(const std::string& body, const Eigen::Vector2d& at_mm) {
  SceneDescription scene;
  LaidDish dish;
  dish.dish = flat_dish();
  dish.centre_mm = {11.0, -7.0};
  scene.dishes.push_back(dish);
  LaidFood food;
  food.name = "it";
  food.body = body;
  food.centre_mm = at_mm;
  food.rotation_deg = 30.0;
  scene.foods.push_back(food);
  return scene;
}

TEST(LaidBody, StandsOnTheBottomWithItsVolume) {
  for (const ProofBody& body : proof_bodies()) {
    const SceneDescription scene = scene_with(std::string(body.id), {2.0, 3.0});
    const std::vector<ServedFood> served = serve_foods(scene, 0, DishShell(flat_dish()), 2);
    ASSERT_EQ(served.size(), 1U);
    EXPECT_EQ(served[0].name, "it");
    EXPECT_TRUE(served[0].is_body);
    EXPECT_DOUBLE_EQ(served[0].volume_ml, body_volume_ml(body.kind, body.size_mm));
    EXPECT_NEAR(served[0].check_volume_ml, served[0].volume_ml, 1e-4 * served[0].volume_ml);
    EXPECT_TRUE(is_closed(served[0].object.mesh));
    float low = 1e9F;
    float high = -1e9F;
    for (const Eigen::Vector3f& vertex : served[0].object.mesh.vertices) {
      low = std::min(low, vertex.z());
      high = std::max(high, vertex.z());
    }
    EXPECT_NEAR(static_cast<double>(low), 4.0, 1e-4);
    EXPECT_NEAR(static_cast<double>(high), 4.0 + body.size_mm[2], 1e-4);
    EXPECT_NEAR(served[0].centre_mm.x(), 13.0, 1e-9);
    EXPECT_NEAR(served[0].centre_mm.y(), -4.0, 1e-9);
  }
}

TEST(LaidBody, IsRefusedOnTheWallAndByAnUnknownName) {
  EXPECT_THROW(serve_foods(scene_with("C400", {40.0, 0.0}), 0, DishShell(flat_dish()), 2),
               std::invalid_argument);
  EXPECT_THROW(serve_foods(scene_with("C50", {200.0, 0.0}), 0, DishShell(flat_dish()), 2),
               std::invalid_argument);
  EXPECT_THROW(serve_foods(scene_with("C1", {0.0, 0.0}), 0, DishShell(flat_dish()), 2),
               std::invalid_argument);
}

TEST(LaidBody, MayNotReachIntoAnother) {
  SceneDescription scene = scene_with("C50", {0.0, 0.0});
  scene.foods.push_back(scene.foods.front());
  scene.foods.back().centre_mm = {10.0, 0.0};
  EXPECT_THROW(serve_foods(scene, 0, DishShell(flat_dish()), 2), std::invalid_argument);
  scene.foods.back().centre_mm = {0.0, 48.0};
  scene.foods.front().centre_mm = {0.0, -10.0};
  EXPECT_EQ(serve_foods(scene, 0, DishShell(flat_dish()), 2).size(), 2U);
}

TEST(LaidBody, IsReadFromASceneAndTellsScenesApart) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "scene.toml";
  write_text(
      folder.path() / "dish.toml",
      "style = \"flat\"\nouter_size_mm = [240.0, 240.0]\nrim_height_mm = 20.0\nbottom_height_mm = 4.0\n");
  const auto scene = [&](const std::string& food) {
    write_text(
        file,
        "[camera]\nwidth = 160\nheight = 120\nfx = 140.0\n[[dishes]]\nfile = \"dish.toml\"\n[[foods]]\n" +
            food + "\n[[views]]\ntilt_deg = 5.0\n");
    return read_scene_file(file);
  };
  const SceneDescription read = scene("body = \"P108\"\ncentre_mm = [4.0, 5.0]\nrotation_deg = 45.0");
  ASSERT_EQ(read.foods.size(), 1U);
  EXPECT_EQ(read.foods[0].body, "P108");
  EXPECT_EQ(read.foods[0].name, "P108");
  EXPECT_EQ(read.foods[0].centre_mm, Eigen::Vector2d(4.0, 5.0));
  EXPECT_EQ(read.foods[0].rotation_deg, 45.0);
  const SceneDescription other =
      scene("body = \"R180\"\nname = \"P108\"\ncentre_mm = [4.0, 5.0]\nrotation_deg = 45.0");
  EXPECT_NE(digest_of(read, {}), digest_of(other, {}));
  EXPECT_THROW(scene("body = \"P1\""), InputError);
  EXPECT_THROW(scene("body = \"P108\"\nkind = \"mash\""), InputError);
}

}  // namespace
}  // namespace traygauge
