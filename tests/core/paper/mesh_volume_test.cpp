// Solids of known volume, sampled exactly by a camera 50 cm away.
#include "core/paper/volume/mesh_volume.hpp"

#include <gtest/gtest.h>

#include <cstdio>

#include "tests/core/stereo/capture_scene.hpp"
#include "tests/core/stereo/synthetic_scene.hpp"
#include "tests/support/allocated.hpp"

namespace traygauge::paper {
namespace {

using test::Allocated;

struct Measured {
  ItemVolume item;
  double covered_px = 0.0;
  double spacing_px = 0.0;
};

class SolidVolume : public ::testing::Test {
 protected:
  template <class Height>
  Measured measure(double tilt_deg, double top_mm, Height&& height, const VolumeParams& params = {}) {
    const auto view = test::look_at_origin(500.0, tilt_deg * CV_PI / 180.0, 0.7);
    const auto picture = test::render_height_field(view, top_mm, 43.0, height);
    FoodMesh mesh;
    EXPECT_TRUE(build_food_mesh(test::view_of(picture.depth_mm), test::view_of(picture.labels), view.camera,
                                {}, *mesh_space_, mesh)
                    .ok());
    EXPECT_TRUE(
        integrate_volume(mesh, test::plane_in_view({Vec3::UnitZ(), 0.0}, view), params, *volume_space_).ok());
    return {volume_space_->items[2], mesh.coverage[2].covered_px, mesh.spacing_px};
  }

  Allocated<FoodMeshWorkspace> mesh_space_{std::size_t{4096}, std::size_t{640}, std::size_t{480}};
  Allocated<VolumeWorkspace> volume_space_{std::size_t{4096}};
};

TEST_F(SolidVolume, GentleSolidsAreWithinOnePercentAtAnyTilt) {
  for (const double tilt : {0.0, 15.0, 30.0, 45.0}) {
    SCOPED_TRACE(tilt);
    const Measured cone =
        measure(tilt, 25.0, [](double x, double y) { return 25.0 * (1.0 - std::hypot(x, y) / 40.0); });
    const Measured paraboloid =
        measure(tilt, 15.0, [](double x, double y) { return 15.0 * (1.0 - (x * x + y * y) / 1600.0); });
    const double ball = (40.0 * 40.0 + 12.0 * 12.0) / 24.0;  // radius of the sphere of a cap 12 mm high
    const Measured cap = measure(tilt, 12.0, [&](double x, double y) {
      return std::sqrt(std::fmax(0.0, ball * ball - x * x - y * y)) - (ball - 12.0);
    });
    const double cone_ml = CV_PI * 1600.0 * 25.0 / 3000.0;
    const double paraboloid_ml = CV_PI * 1600.0 * 15.0 / 2000.0;
    const double cap_ml = CV_PI * 12.0 * 12.0 * (3.0 * ball - 12.0) / 3000.0;
    std::printf("tilt %2.0f: cone %+.2f%%  paraboloid %+.2f%%  spherical cap %+.2f%%\n", tilt,
                100 * (cone.item.volume_ml / cone_ml - 1),
                100 * (paraboloid.item.volume_ml / paraboloid_ml - 1),
                100 * (cap.item.volume_ml / cap_ml - 1));
    EXPECT_NEAR(cone.item.volume_ml, cone_ml, 0.01 * cone_ml);
    EXPECT_NEAR(paraboloid.item.volume_ml, paraboloid_ml, 0.01 * paraboloid_ml);
    EXPECT_NEAR(cap.item.volume_ml, cap_ml, 0.01 * cap_ml);
    EXPECT_NEAR(cap.item.mean_height_mm, cap.item.volume_ml * 1000.0 / cap.item.area_mm2, 1e-9);
    EXPECT_NEAR(paraboloid.item.max_height_mm, 15.0, 0.4);
    EXPECT_LT(cone.item.area_mm2, CV_PI * 1600.0);
    EXPECT_GT(cone.item.area_mm2, 0.93 * CV_PI * 1600.0);
  }
}

TEST_F(SolidVolume, ABoxSeenFromAboveLosesItsErodedBorderOnly) {
  const auto box = [](double x, double y) { return std::abs(x) < 35.0 && std::abs(y) < 25.0 ? 30.0 : -1.0; };
  const Measured top = measure(0.0, 30.0, box);
  const double pixel_mm = 470.0 / 800.0;
  EXPECT_NEAR(top.item.volume_ml, top.covered_px * pixel_mm * pixel_mm * 30.0 / 1000.0, 0.01);
  EXPECT_LT(top.item.volume_ml, 105.0);
  const double cell_mm = top.spacing_px * pixel_mm;
  EXPECT_GT(top.item.volume_ml, (70.0 - 2.0 * cell_mm) * (50.0 - 2.0 * cell_mm) * 30.0 / 1000.0);
  EXPECT_NEAR(top.item.max_height_mm, 30.0, 0.01);
}

TEST_F(SolidVolume, SteepSolidsAreBiasedByWhatIsHidden) {
  const auto box = [](double x, double y) { return std::abs(x) < 35.0 && std::abs(y) < 25.0 ? 30.0 : -1.0; };
  const auto ball = [](double x, double y) {
    const double squared = 900.0 - x * x - y * y;
    return squared > 0.0 ? std::sqrt(squared) : -1.0;
  };
  const double box_ml = 105.0;
  const double ball_ml = 2.0 / 3.0 * CV_PI * 27.0;
  for (const double tilt : {0.0, 15.0, 30.0, 45.0}) {
    const double box_error = measure(tilt, 30.0, box).item.volume_ml / box_ml - 1.0;
    const double ball_error = measure(tilt, 30.0, ball).item.volume_ml / ball_ml - 1.0;
    std::printf("tilt %2.0f: box %+.2f%%  hemisphere %+.2f%%\n", tilt, 100 * box_error, 100 * ball_error);
    EXPECT_LT(box_error, 0.0);
    EXPECT_GT(box_error, -0.08);
    EXPECT_LT(ball_error, 0.0);
    EXPECT_GT(ball_error, -0.25);
  }
}

// Points of a sheet at height 1, 2, … over z = 0, camera above.
struct Sheet {
  std::vector<MeshPoint> points;
  std::vector<MeshTriangle> triangles;
  FoodMesh mesh() const { return {points, triangles, {}, 1.0, 0, 0}; }
};

TEST(Volume, IsExactForAPrismWithASlantedTop) {
  // Camera at the origin, table at z = 500; heights 10, 20, 30 over a triangle of 200 mm².
  const Sheet sheet{{{{0, 0, 490}, 5}, {{20, 0, 480}, 5}, {{0, 20, 470}, 5}}, {{{0, 1, 2}, 5}}};
  Allocated<VolumeWorkspace> space(std::size_t{16});
  ASSERT_TRUE(integrate_volume(sheet.mesh(), {-Vec3::UnitZ(), -500.0}, {}, *space).ok());
  EXPECT_NEAR(space->items[5].volume_ml, 4.0, 1e-12);
  EXPECT_NEAR(space->items[5].area_mm2, 200.0, 1e-9);
  EXPECT_NEAR(space->items[5].mean_height_mm, 20.0, 1e-9);
  EXPECT_NEAR(space->items[5].max_height_mm, 30.0, 1e-4);
  EXPECT_EQ(space->items[5].label, 5);
  EXPECT_EQ(space->items[6].volume_ml, 0.0);
}

TEST(Volume, AFoldAdds) {
  const Sheet sheet{{{{0, 0, 490}, 5}, {{20, 0, 490}, 5}, {{0, 20, 490}, 5}},
                    {{{0, 1, 2}, 5}, {{0, 2, 1}, 5}}};
  Allocated<VolumeWorkspace> space(std::size_t{16});
  ASSERT_TRUE(integrate_volume(sheet.mesh(), {-Vec3::UnitZ(), -500.0}, {}, *space).ok());
  EXPECT_NEAR(space->items[5].volume_ml, 4.0, 1e-12);
}

TEST(Volume, SurfaceBelowTheDishCountsNegative) {
  const Sheet sheet{{{{0, 0, 510}, 5}, {{20, 0, 510}, 5}, {{0, 20, 510}, 5}}, {{{0, 1, 2}, 5}}};
  Allocated<VolumeWorkspace> space(std::size_t{16});
  ASSERT_TRUE(integrate_volume(sheet.mesh(), {-Vec3::UnitZ(), -500.0}, {}, *space).ok());
  EXPECT_NEAR(space->items[5].volume_ml, -2.0, 1e-12);
}

TEST(Volume, RefusesAnEmptyMeshAndOneThatIsTooLarge) {
  Allocated<VolumeWorkspace> space(std::size_t{2});
  EXPECT_EQ(integrate_volume({}, {}, {}, *space).code(), StatusCode::too_little_depth);
  const Sheet sheet{{{{0, 0, 490}, 5}, {{20, 0, 490}, 5}, {{0, 20, 490}, 5}}, {{{0, 1, 2}, 5}}};
  EXPECT_EQ(integrate_volume(sheet.mesh(), {}, {}, *space).code(), StatusCode::out_of_memory);
}

}  // namespace
}  // namespace traygauge::paper
