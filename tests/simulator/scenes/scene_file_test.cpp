#include "simulator/scenes/scene_file.hpp"

#include <gtest/gtest.h>

#include <string>

#include "simulator/capture/input_error.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"

namespace traygauge {
namespace {

constexpr const char* kScene = R"(seed = 7
[camera]
width = 160
height = 120
fx = 140.0
[[dishes]]
file = "plate.toml"
centre_mm = [10, -5]
colour = "#E0E0D8"
lines = [[4.0, 2.0]]
[[dishes]]
file = "plate.toml"
centre_mm = [0, 300]
[[foods]]
kind = "mash"
[[foods]]
kind = "tomato_soup"
dish = 201
level_mm = 15
[card]
centre_mm = [180, 0]
[[views]]
distance_mm = 520
[[views]]
distance_mm = 500
tilt_deg = 20
motion_mm = [0.5, 0, 0]
motion_deg = [0, 0.2, 0]
)";

class SceneFile : public testing::Test {
 protected:
  SceneFile() {
    write_text(folder_.path() / "plate.toml",
               "outer_size_mm = [240, 240]\nrim_height_mm = 24\nbottom_height_mm = 4\nprofile = [[0, 24], "
               "[40, 4]]\n");
  }

  SceneDescription read(const std::string& text) {
    write_text(folder_.path() / "scene.toml", text);
    return read_scene_file(folder_.path() / "scene.toml");
  }

  std::string error_of(const std::string& text) {
    try {
      read(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  std::string with(const std::string& from, const std::string& to) {
    std::string text = kScene;
    return text.replace(text.find(from), from.size(), to);
  }

  TemporaryFolder folder_;
};

TEST_F(SceneFile, IsRead) {
  const SceneDescription scene = read(kScene);
  EXPECT_EQ(scene.name, "scene");
  EXPECT_EQ(scene.seed, 7U);
  ASSERT_EQ(scene.dishes.size(), 2U);
  EXPECT_EQ(scene.dishes[0].dish.label, 1);
  EXPECT_EQ(scene.dishes[1].dish.label, 201);
  EXPECT_EQ(scene.dishes[0].glaze.srgb, 0xE0E0D8U);
  EXPECT_EQ(scene.foods[1].dish, 1);
  EXPECT_DOUBLE_EQ(scene.foods[1].level_mm, 15.0);
  EXPECT_DOUBLE_EQ(scene.foods[0].size.length_mm, 92.0);
  ASSERT_EQ(scene.pairs.size(), 1U);
  EXPECT_EQ(scene.lamps.size(), 1U);
  EXPECT_DOUBLE_EQ(scene.photography.camera.cx_px, 79.5);
  EXPECT_TRUE(scene.views[0].motion_deg.isZero());
  EXPECT_EQ(scene.views[1].motion_mm, Eigen::Vector3d(0.5, 0.0, 0.0));
  EXPECT_EQ(scene.views[1].motion_deg, Eigen::Vector3d(0.0, 0.2, 0.0));
}

TEST_F(SceneFile, PrintLiesBesideTheScene) {
  EXPECT_TRUE(read(kScene).card.print.empty());
  EXPECT_EQ(read(with("[card]", "[card]\nprint = \"card.png\"")).card.print, folder_.path() / "card.png");
}

TEST_F(SceneFile, NamesFileKeyAndWhatWasExpected) {
  struct Mistake {
    std::string text;
    std::string key;
  };
  const Mistake mistakes[] = {
      {with("seed = 7", "sead = 7"), "sead"},
      {with("fx = 140.0", "fx = -1.0"), "camera.fx"},
      {with("fx = 140.0", ""), "camera.fx"},
      {with("\"mash\"", "\"mush\""), "foods[0].kind"},
      {with("dish = 201", "dish = 3"), "foods[1].dish"},
      {with("level_mm = 15", "level_mm = 60"), "foods[1].level_mm"},
      {with("level_mm = 15", ""), "foods[1].level_mm"},
      {with("#E0E0D8", "grey"), "dishes[0].colour"},
      {with("centre_mm = [180, 0]", "centre_mm = [180]"), "card.centre_mm"},
      {with("tilt_deg = 20", "tilt_deg = 120"), "views[1].tilt_deg"},
      {with("motion_deg = [0, 0.2, 0]", "motion_deg = 0.2"), "views[1].motion_deg"},
      {std::string("pairs = [[0, 2]]\n") + kScene, "pairs[0][1]"},
      {std::string("name = \"../x\"\n") + kScene, "name"},
      {std::string(kScene) + "[table]\nsurface = \"marble\"\n", "table.surface"},
  };
  for (const Mistake& mistake : mistakes) {
    const std::string error = error_of(mistake.text);
    EXPECT_NE(error.find("scene.toml"), std::string::npos) << mistake.key << ": " << error;
    EXPECT_NE(error.find(mistake.key), std::string::npos) << mistake.key << ": " << error;
    EXPECT_NE(error.find("expected"), std::string::npos) << mistake.key << ": " << error;
  }
}

}  // namespace
}  // namespace traygauge
