#include "simulator/scenes/scene_sets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "simulator/scenes/capture_documents.hpp"
#include "simulator/scenes/food_kinds.hpp"
#include "simulator/scenes/laid_scene.hpp"
#include "simulator/scenes/mesh_tools.hpp"
#include "simulator/scenes/scene_poses.hpp"
#include "simulator/scenes/scene_views.hpp"

namespace traygauge {
namespace {

constexpr std::uint64_t kSeed = 1;

double angle_of(const SceneDescription& scene, const std::array<int, 2>& pair) {
  const LaidDish& dish = scene.dishes.front();
  const Eigen::Vector3d middle(dish.centre_mm.x(), dish.centre_mm.y(), dish.dish.bottom_height_mm);
  return relative_angle_deg(view_camera(scene, scene.views[static_cast<std::size_t>(pair[0])]),
                            view_camera(scene, scene.views[static_cast<std::size_t>(pair[1])]), middle);
}

std::set<std::string> kinds_of(const std::vector<SceneDescription>& scenes) {
  std::set<std::string> kinds;
  for (const SceneDescription& scene : scenes) {
    for (const LaidFood& food : scene.foods) kinds.insert(food.kind);
  }
  return kinds;
}

// Paper, section IV-A.
TEST(SceneSets, MealsAreAsManyAndSeenAsInThePaper) {
  const auto scenes = make_scenes("meals-45", kSeed, SetSize::full);
  ASSERT_EQ(scenes.size(), 45U);
  std::size_t items = 0;
  std::size_t with_three = 0;
  for (const SceneDescription& scene : scenes) {
    items += scene.foods.size();
    if (scene.foods.size() == 3) ++with_three;
    ASSERT_EQ(scene.pairs.size(), 3U);
    for (const auto& pair : scene.pairs) {
      EXPECT_GE(angle_of(scene, pair), 5.0) << scene.name;
      EXPECT_LE(angle_of(scene, pair), 35.0) << scene.name;
    }
    for (const Photograph& view : scene.views) {
      EXPECT_GE(view.distance_mm, 400.0);
      EXPECT_LE(view.distance_mm, 600.0);
      EXPECT_LE(view.tilt_deg, 45.0);
      EXPECT_TRUE(is_all_in_picture(scene, view)) << scene.name;
      EXPECT_FALSE(is_card_hidden(scene, view)) << scene.name;
    }
  }
  EXPECT_EQ(items, 113U);
  EXPECT_EQ(with_three, 23U);
  EXPECT_GE(kinds_of(scenes).size(), 20U);
}

TEST(SceneSets, ArmTurnsInStepsOfFiveDegrees) {
  const auto scenes = make_scenes("angles-13", kSeed, SetSize::full);
  ASSERT_EQ(scenes.size(), 13U);
  for (const SceneDescription& scene : scenes) {
    ASSERT_EQ(scene.pairs.size(), 7U);
    for (std::size_t i = 0; i < 7; ++i) {
      EXPECT_NEAR(angle_of(scene, scene.pairs[i]), 5.0 * static_cast<double>(i + 1), 1e-6) << scene.name;
    }
    // The arm's axis is the world's x.
    const Eigen::Matrix3d first = camera_from_world(scene.views[0]).linear();
    for (const Photograph& view : scene.views) {
      ASSERT_TRUE(view.arm_angle_deg.has_value());
      const Eigen::AngleAxisd arm(radians(*view.arm_angle_deg), Eigen::Vector3d::UnitX());
      EXPECT_TRUE((camera_from_world(view).linear() * arm).isApprox(first, 1e-9)) << scene.name;
    }
  }
}

TEST(SceneSets, PlatesCarryTheSamePortions) {
  const auto scenes = make_scenes("plates-18", kSeed, SetSize::full);
  ASSERT_EQ(scenes.size(), 18U);
  for (std::size_t meal = 0; meal < 6; ++meal) {
    std::set<std::string> styles;
    std::set<std::pair<std::uint64_t, double>> portions;
    for (std::size_t plate = 0; plate < 3; ++plate) {
      const SceneDescription& scene = scenes[3 * meal + plate];
      styles.insert(scene.dishes.front().dish.style);
      for (const LaidFood& food : scene.foods) portions.insert({food.seed, food.size.length_mm});
    }
    EXPECT_EQ(styles.size(), 3U);
    EXPECT_EQ(portions.size(), 2U);
  }
}

TEST(SceneSets, OtherMealsShareNoFoodAndNoTableWithTheRest) {
  const auto other = make_scenes("meals-14", kSeed, SetSize::full);
  ASSERT_EQ(other.size(), 14U);
  std::set<SurfaceKind> tables;
  for (const SceneDescription& scene : other) tables.insert(scene.table.kind);
  const std::set<std::string> kinds = kinds_of(other);
  for (const char* name : {"meals-45", "angles-13", "plates-18", "trays-8", "moved-4", "training-24"}) {
    const auto scenes = make_scenes(name, kSeed, SetSize::full);
    for (const std::string& kind : kinds_of(scenes))
      EXPECT_FALSE(kinds.contains(kind)) << kind << " in " << name;
    for (const SceneDescription& scene : scenes)
      EXPECT_FALSE(tables.contains(scene.table.kind)) << scene.name;
  }
}

TEST(SceneSets, TraysWithFoodBesideThePlateAreFoundForEverySeed) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed)
    EXPECT_EQ(make_scenes("beside-8", seed, SetSize::full).size(), 8U) << seed;
}

TEST(SceneSets, FoodBesideThePlateLiesOnTheTray) {
  for (const SceneDescription& scene : make_scenes("beside-8", kSeed, SetSize::full)) {
    const auto pieces = std::ranges::count_if(scene.dishes, &LaidDish::is_ground);
    EXPECT_EQ(static_cast<std::size_t>(pieces) + 1, scene.dishes.size()) << scene.name;
    EXPECT_FALSE(scene.dishes.front().is_ground) << scene.name;
    for (std::size_t i = 1; i < scene.dishes.size(); ++i) {
      const auto of_piece = [&](const LaidFood& food) { return food.dish == static_cast<int>(i); };
      EXPECT_EQ(std::ranges::count_if(scene.foods, of_piece), 1) << scene.name;
      EXPECT_TRUE(is_tray_place(static_cast<std::uint8_t>(scene.dishes[i].dish.label))) << scene.name;
    }
    // Nothing describes the ground.
    EXPECT_TRUE(compose_capture(scene).contains("dish")) << scene.name;
  }
}

TEST(SceneSets, MovedTraysTurnUnderAStillCamera) {
  for (const SceneDescription& scene : make_scenes("moved-4", kSeed, SetSize::full)) {
    ASSERT_EQ(scene.views.size(), 2U);
    EXPECT_DOUBLE_EQ(scene.views[0].azimuth_deg, scene.views[1].azimuth_deg);
    EXPECT_DOUBLE_EQ(scene.views[0].distance_mm, scene.views[1].distance_mm);
    EXPECT_GE(angle_of(scene, {0, 1}), 8.0);
    // The camera stands still in the room.
    const auto in_room = [&](const Photograph& view) {
      return (view_camera(scene, view).camera_from_world * world_from_room(view)).matrix().eval();
    };
    EXPECT_TRUE(in_room(scene.views[0]).isApprox(in_room(scene.views[1]), 1e-9));
  }
}

TEST(SceneSets, SlipsMoveOneThingInTheSecondView) {
  for (const SceneDescription& scene : make_scenes("slips-10", kSeed, SetSize::full)) {
    ASSERT_EQ(scene.pairs.size() + 1, scene.views.size());
    EXPECT_TRUE(scene.views[0].displaced.empty());
    EXPECT_TRUE(scene.views[1].displaced.empty());
    std::map<int, std::vector<double>> lengths_mm;
    for (std::size_t i = 2; i < scene.views.size(); ++i) {
      EXPECT_TRUE(view_camera(scene, scene.views[i])
                      .camera_from_world.isApprox(view_camera(scene, scene.views[1]).camera_from_world));
      ASSERT_EQ(scene.views[i].displaced.size(), 1U);
      const Displacement& moved = scene.views[i].displaced.front();
      lengths_mm[moved.label].push_back(moved.shift_mm.norm());
    }
    EXPECT_TRUE(lengths_mm.contains(1) && lengths_mm.contains(255)) << scene.name;
    for (const auto& [label, of_label] : lengths_mm) {
      EXPECT_NEAR(of_label.front(), 0.5, 1e-9) << +label;
      EXPECT_NEAR(of_label.back(), 15.0, 1e-9) << +label;
    }
  }
}

// A card leans on its lower edge, or is bent up at its right one: neither goes into the table, and a bent one
// keeps its thickness everywhere.
TEST(SceneSets, SpoiltCardsLeanOrAreBent) {
  std::vector<double> leans_deg;
  std::vector<double> bends_mm;
  for (SceneDescription& scene : make_scenes("cards-8", kSeed, SetSize::full)) {
    const LaidCard card = scene.card;
    leans_deg.push_back(card.tilt_deg);
    bends_mm.push_back(card.curl_mm);
    EXPECT_TRUE((card.tilt_deg > 0.0) != (card.curl_mm > 0.0)) << scene.name;
    LaidScene laid(scene, 1);
    const Scene& rendered = laid.scene_of(scene.views[0]);
    const auto of_card = std::ranges::find(rendered.objects, kCardLabel, &SceneObject::label);
    ASSERT_NE(of_card, rendered.objects.end());
    EXPECT_TRUE(is_closed(of_card->mesh));
    EXPECT_NEAR(enclosed_volume_mm3(of_card->mesh), card.width_mm * card.height_mm * card.thickness_mm,
                0.05 * card.width_mm * card.height_mm);
    const auto [lowest, highest] =
        std::ranges::minmax(of_card->mesh.vertices, {}, [](const Eigen::Vector3f& at) { return at.z(); });
    EXPECT_NEAR(lowest.z(), 0.0, 0.06);
    EXPECT_NEAR(highest.z(),
                card.height_mm * std::sin(radians(card.tilt_deg)) +
                    card.thickness_mm * std::cos(radians(card.tilt_deg)) + card.curl_mm,
                0.01);
  }
  EXPECT_EQ(leans_deg, (std::vector<double>{0.5, 1.0, 2.0, 4.0, 0.0, 0.0, 0.0, 0.0}));
  EXPECT_EQ(bends_mm, (std::vector<double>{0.0, 0.0, 0.0, 0.0, 1.0, 2.0, 4.0, 8.0}));
}

// A dish takes its food along, a food moves alone; what is painted on them moves with them.
TEST(SceneSets, WhatIsDisplacedKeepsItsLook) {
  SceneDescription description = make_scenes("meals-45", kSeed, SetSize::reduced).front();
  LaidScene laid(description, 1);
  Photograph still = description.views[0];
  const Scene before = laid.scene_of(still);
  for (const std::uint8_t moved : {std::uint8_t{1}, std::uint8_t{2}, std::uint8_t{255}}) {
    Photograph view = still;
    view.displaced = {{moved, {3.0, -4.0}, 0.0}};
    const Scene& after = laid.scene_of(view);
    ASSERT_EQ(after.objects.size(), before.objects.size());
    for (std::size_t i = 0; i < before.objects.size(); ++i) {
      const std::uint8_t label = before.objects[i].label;
      const bool goes_along = label == moved || (moved == 1 && label > 1 && label < 200);
      const Eigen::Vector3f shift = goes_along ? Eigen::Vector3f(3.0F, -4.0F, 0.0F) : Eigen::Vector3f::Zero();
      const auto& vertices = before.objects[i].mesh.vertices;
      ASSERT_EQ(after.objects[i].mesh.vertices.size(), vertices.size());
      const auto vertex = vertices[vertices.size() / 2];
      EXPECT_LT((after.objects[i].mesh.vertices[vertices.size() / 2] - vertex - shift).norm(), 1e-3F)
          << +label;
      const Eigen::Vector3f up = Eigen::Vector3f::UnitZ();
      EXPECT_TRUE(after.objects[i]
                      .material->at(vertex + shift, up)
                      .base.isApprox(before.objects[i].material->at(vertex, up).base, 0.05F))
          << +label;
    }
  }
  Photograph view = still;
  view.displaced = {{77, {1.0, 0.0}, 0.0}};
  EXPECT_THROW(laid.scene_of(view), std::invalid_argument);
}

TEST(SceneSets, SeedDecides) {
  const auto first = make_scenes("trays-8", 5, SetSize::full);
  const auto again = make_scenes("trays-8", 5, SetSize::full);
  const auto other = make_scenes("trays-8", 6, SetSize::full);
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].dishes[0].centre_mm, again[i].dishes[0].centre_mm);
    EXPECT_EQ(first[i].foods[0].seed, again[i].foods[0].seed);
    EXPECT_NE(first[i].foods[0].seed, other[i].foods[0].seed);
  }
}

TEST(SceneSets, FirstPairsAreSeenFromTheSameViews) {
  const auto first_of = [](std::string_view set, std::size_t pairs) {
    SceneDescription scene = make_scenes(set, kSeed, SetSize::full).front();
    keep_first_pairs(scene, pairs);
    return scene;
  };
  const SceneDescription whole = make_scenes("meals-45", kSeed, SetSize::full).front();
  const SceneDescription one = first_of("meals-45", 1);
  ASSERT_EQ(one.views.size(), 2U);
  EXPECT_EQ(one.pairs, (std::vector<std::array<int, 2>>{{0, 1}}));
  for (std::size_t i = 0; i < one.views.size(); ++i)
    EXPECT_EQ(one.views[i].target_mm, whole.views[i].target_mm);
  EXPECT_EQ(first_of("angles-13", 3).views.size(), 4U);
  EXPECT_EQ(first_of("meals-45", 9).pairs, whole.pairs);
}

TEST(SceneSets, ReducedScenesSeeTheSameInSmallerPictures) {
  for (const SceneSet& set : scene_sets()) {
    const auto full = make_scenes(set.name, kSeed, SetSize::full);
    const auto reduced = make_scenes(set.name, kSeed, SetSize::reduced);
    ASSERT_FALSE(reduced.empty());
    EXPECT_LE(reduced.size(), 24U);  // as many trays of a station as tell dirt on its lens
    EXPECT_EQ(reduced[0].photography.camera.size.width, 800);
    // The network has to know what lies half outside.
    for (const Photograph& view : reduced[0].views)
      EXPECT_TRUE(set.name == "training-24" || is_all_in_picture(reduced[0], view));
    EXPECT_EQ(reduced[0].foods[0].seed, full[0].foods[0].seed);
  }
  EXPECT_THROW(make_scenes("meals-46", kSeed, SetSize::full), std::invalid_argument);
}

TEST(SceneSets, TrainingScenesHoldWhatTheOthersLack) {
  std::size_t foods = 0;
  std::size_t pale = 0;
  std::set<ThingKind> things;
  std::set<std::uint32_t> glazes;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const auto scenes = make_scenes("training-24", seed, SetSize::full);
    ASSERT_EQ(scenes.size(), 24U);
    for (const SceneDescription& scene : scenes) {
      EXPECT_EQ(scene.views.size(), 4U);
      for (const LaidFood& food : scene.foods) {
        ++foods;
        if (find_food_kind(food.kind)->group == FoodGroup::training) ++pale;
      }
      for (const LaidDish& dish : scene.dishes) glazes.insert(dish.glaze.srgb);
      for (const Thing& thing : scene.things) {
        things.insert(thing.kind);
        for (const LaidDish& dish : scene.dishes) {
          EXPECT_GT((thing.centre_mm - dish.centre_mm).norm(), 0.5 * dish.dish.outer_size_mm[1])
              << scene.name;
        }
      }
    }
  }
  EXPECT_GT(2 * pale, foods);
  EXPECT_EQ(things.size(), 7U);
  EXPECT_GT(glazes.size(), 15U);
}

TEST(SceneSets, QuickScenesSeeTheSameInPicturesOfAFifth) {
  quick_settings().check();
  for (const SceneSet& set : scene_sets()) {
    const auto full = make_scenes(set.name, kSeed, SetSize::full);
    const auto quick = make_scenes(set.name, kSeed, SetSize::quick);
    ASSERT_EQ(quick.size(), full.size()) << set.name;
    EXPECT_NE(quick[0].origin.find("quick"), std::string::npos);
    const CameraDescription& camera = quick[0].photography.camera;
    EXPECT_EQ(camera.size, (PictureSize{320, 240}));
    const CameraDescription& usual = full[0].photography.camera;
    EXPECT_NEAR(5.0 * (camera.cx_px + 0.5), usual.cx_px + 0.5, 1e-9);
    EXPECT_NEAR(5.0 * (camera.cy_px + 0.5), usual.cy_px + 0.5, 1e-9);
    EXPECT_NEAR(5.0 * camera.fx_px, usual.fx_px, 1e-9);
    EXPECT_EQ(quick[0].foods[0].seed, full[0].foods[0].seed);
  }
}

}  // namespace
}  // namespace traygauge
