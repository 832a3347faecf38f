#include "simulator/scenes/things.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "simulator/scenes/mesh_tools.hpp"
#include "simulator/scenes/scene_poses.hpp"
#include "simulator/scenes/solid_meshes.hpp"

namespace traygauge {
namespace {

constexpr ThingKind kKinds[] = {
    ThingKind::cup,  ThingKind::hand,   ThingKind::phone,           ThingKind::wallet,
    ThingKind::keys, ThingKind::packet, ThingKind::napkin_with_roll};

TEST(Things, AreSolidsThatStandOnTheirGround) {
  for (const ThingKind kind : kKinds) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      Thing thing;
      thing.kind = kind;
      thing.seed = seed;
      thing.base_mm = 7.0;
      for (const SceneObject& object : objects_of(thing)) {
        EXPECT_TRUE(is_closed(object.mesh)) << static_cast<int>(kind);
        EXPECT_GT(enclosed_volume_mm3(object.mesh), 0.0) << static_cast<int>(kind);
        EXPECT_EQ(object.label, 0);
        const auto lowest = std::ranges::min(object.mesh.vertices, {}, [](const auto& at) { return at.z(); });
        EXPECT_GE(lowest.z(), 7.0F) << static_cast<int>(kind) << " " << seed;
      }
    }
  }
}

// Except a hand's arm, which lies behind it.
TEST(Things, CoverNoMoreThanTheySay) {
  for (const ThingKind kind : kKinds) {
    const Eigen::Vector2d half_mm = half_size_mm(kind);
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      Thing thing;
      thing.kind = kind;
      thing.seed = seed;
      for (const SceneObject& object : objects_of(thing)) {
        for (const Eigen::Vector3f& at : object.mesh.vertices) {
          if (kind == ThingKind::hand && static_cast<double>(at.x()) < -half_mm.x()) continue;
          EXPECT_LE(std::abs(static_cast<double>(at.x())), half_mm.x()) << static_cast<int>(kind);
          EXPECT_LE(std::abs(static_cast<double>(at.y())), half_mm.y()) << static_cast<int>(kind);
        }
      }
    }
  }
}

TEST(Things, AreOfTheKindThatTheyShow) {
  const auto kinds_of = [](ThingKind kind) {
    Thing thing;
    thing.kind = kind;
    std::set<TruthKind> kinds;
    for (const SceneObject& object : objects_of(thing)) kinds.insert(object.kind);
    return kinds;
  };
  EXPECT_EQ(kinds_of(ThingKind::cup), std::set{TruthKind::cup});
  EXPECT_EQ(kinds_of(ThingKind::hand), std::set{TruthKind::hand});
  EXPECT_EQ(kinds_of(ThingKind::phone), std::set{TruthKind::other});
  EXPECT_EQ(kinds_of(ThingKind::napkin_with_roll), (std::set{TruthKind::food, TruthKind::napkin}));
}

TEST(SolidMeshes, HaveTheVolumesOfTheirSolids) {
  EXPECT_NEAR(enclosed_volume_mm3(superquadric_mesh({30.0, 20.0, 10.0}, 2.0, 2.0)), 25133.0, 0.01 * 25133.0);
  // A cylinder of radius 10 and length 40, and a sphere.
  EXPECT_NEAR(enclosed_volume_mm3(limb_mesh({0.0, 0.0, 0.0}, {0.0, 40.0, 0.0}, 10.0, 10.0)), 16755.0,
              0.01 * 16755.0);
}

}  // namespace
}  // namespace traygauge
