#include "core/paper/surface/food_mesh.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <random>

#include "tests/core/stereo/capture_scene.hpp"
#include "tests/support/allocated.hpp"

namespace traygauge::paper {
namespace {

const PinholeCamera kCamera{700.0, 710.0, 320.0, 240.0};

// Depth of the plane n · X = d.
cv::Mat1f plane_depth(cv::Size size, const Vec3& normal, double distance) {
  cv::Mat1f depth(size);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      depth(y, x) = static_cast<float>(distance / normal.dot(kCamera.ray(Vec2(x, y)).homogeneous()));
    }
  }
  return depth;
}

class FoodMeshTest : public ::testing::Test {
 protected:
  Status build(const FoodMeshParams& params = {}) {
    return build_food_mesh(test::view_of(depth_), test::view_of(labels_), kCamera, params, *space_, mesh_);
  }
  double picture_area(const MeshTriangle& triangle) const {
    std::array<Vec2, 3> p;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& corner = mesh_.points[static_cast<std::size_t>(triangle.corners[k])].position_mm;
      p[k] = kCamera.pixel(corner.head<2>() / corner.z());
    }
    const Vec2 u = p[1] - p[0];
    const Vec2 v = p[2] - p[0];
    return 0.5 * (u.x() * v.y() - u.y() * v.x());
  }

  test::Allocated<FoodMeshWorkspace> space_{std::size_t{4096}, std::size_t{640}, std::size_t{480}};
  cv::Mat1b labels_ = cv::Mat1b(480, 640, std::uint8_t{1});
  Vec3 normal_ = Vec3(0.2, -0.3, 1.0).normalized();
  cv::Mat1f depth_ = plane_depth(labels_.size(), normal_, 450.0);
  FoodMesh mesh_;
};

TEST_F(FoodMeshTest, PointsStayUnderTheCapAndNearIt) {
  std::mt19937 generator(3);
  std::uniform_int_distribution<int> place(60, 420);
  std::uniform_int_distribution<int> radius(30, 110);
  for (int round = 0; round < 12; ++round) {
    SCOPED_TRACE(round);
    labels_ = std::uint8_t{1};
    for (int item = 2; item < 6; ++item) {
      cv::ellipse(labels_, {place(generator) + 60, place(generator)}, {radius(generator), radius(generator)},
                  place(generator), 0, 360, item, cv::FILLED);
    }
    for (const int points : {256, 1024, 4096}) {
      FoodMeshParams params;
      params.points = points;
      ASSERT_TRUE(build(params).ok());
      EXPECT_LE(mesh_.grid_points, points);
      EXPECT_GE(mesh_.grid_points, 0.97 * points);
      EXPECT_EQ(static_cast<int>(mesh_.points.size()), mesh_.grid_points);
    }
  }
}

TEST_F(FoodMeshTest, FewPixelsGiveOnePointEach) {
  labels_(cv::Rect(100, 100, 30, 20)) = std::uint8_t{7};
  ASSERT_TRUE(build().ok());
  EXPECT_EQ(mesh_.points.size(), 600U);
  EXPECT_EQ(mesh_.triangles.size(), 2U * 29U * 19U);
  EXPECT_DOUBLE_EQ(mesh_.spacing_px, 1.0);
}

TEST_F(FoodMeshTest, PointsLieOnTheSurfaceAndTrianglesRunClockwise) {
  cv::circle(labels_, {300, 250}, 150, 9, cv::FILLED);
  ASSERT_TRUE(build().ok());
  for (const MeshPoint& point : mesh_.points) EXPECT_NEAR(normal_.dot(point.position_mm), 450.0, 1e-3);
  double area = 0.0;
  for (const MeshTriangle& triangle : mesh_.triangles) {
    EXPECT_GT(picture_area(triangle), 0.0);
    area += picture_area(triangle);
  }
  EXPECT_NEAR(area, mesh_.coverage[9].covered_px, 1e-2);
  EXPECT_EQ(mesh_.coverage[9].label_px, static_cast<std::uint32_t>(cv::countNonZero(labels_ == 9)));
}

TEST_F(FoodMeshTest, EachLabelIsErodedByHalfACell) {
  labels_(cv::Rect(101, 83, 200, 240)) = std::uint8_t{2};
  labels_(cv::Rect(301, 83, 150, 240)) = std::uint8_t{3};
  ASSERT_TRUE(build().ok());
  const double s = mesh_.spacing_px;
  // Every side loses between nothing and one cell; two sides together one cell, give or take the rounding.
  for (const auto& [label, width] : {std::pair{2, 200.0}, {3, 150.0}}) {
    const double expected = (width - s) * (240.0 - s);
    EXPECT_NEAR(mesh_.coverage[static_cast<std::size_t>(label)].covered_px, expected, s * (240.0 + width));
    EXPECT_LT(mesh_.coverage[static_cast<std::size_t>(label)].share(), 1.0);
  }
  const double together = mesh_.coverage[2].covered_px + mesh_.coverage[3].covered_px;
  EXPECT_NEAR(together, (350.0 - 2 * s) * (240.0 - s), 1.5 * 240.0 + 350.0);
  for (const MeshTriangle& triangle : mesh_.triangles) {
    for (const std::int32_t corner : triangle.corners) {
      EXPECT_EQ(mesh_.points[static_cast<std::size_t>(corner)].label, triangle.label);
    }
  }
}

TEST_F(FoodMeshTest, GapsAreBridgedAlongThePlaneOrLeftOpen) {
  labels_(cv::Rect(100, 100, 300, 200)) = std::uint8_t{2};
  depth_(cv::Rect(200, 150, 60, 50)) = std::numeric_limits<float>::quiet_NaN();
  depth_(cv::Rect(200, 150, 20, 50)) = -1.0F;  // nor is that a depth
  ASSERT_TRUE(build().ok());
  const double whole = mesh_.coverage[2].covered_px;
  EXPECT_NEAR(mesh_.bridged_points, 60.0 * 50.0 / (mesh_.spacing_px * mesh_.spacing_px), 60.0);
  for (const MeshPoint& point : mesh_.points) EXPECT_NEAR(normal_.dot(point.position_mm), 450.0, 1e-3);

  FoodMeshParams open;
  open.max_gap_cells = 0;
  ASSERT_TRUE(build(open).ok());
  EXPECT_EQ(mesh_.bridged_points, 0);
  EXPECT_NEAR(whole - mesh_.coverage[2].covered_px, (60.0 + mesh_.spacing_px) * (50.0 + mesh_.spacing_px),
              3.0 * 110.0 * mesh_.spacing_px / 2.0);
  EXPECT_LT(mesh_.points.size(), static_cast<std::size_t>(mesh_.grid_points));
}

TEST_F(FoodMeshTest, NothingIsExtrapolatedBeyondKnownDepth) {
  labels_(cv::Rect(100, 100, 300, 200)) = std::uint8_t{2};
  depth_(cv::Rect(300, 0, 340, 480)) = std::numeric_limits<float>::quiet_NaN();
  ASSERT_TRUE(build().ok());
  EXPECT_EQ(mesh_.bridged_points, 0);
  for (const MeshPoint& point : mesh_.points) {
    EXPECT_LT(kCamera.pixel(point.position_mm.head<2>() / point.position_mm.z()).x(), 300.0);
  }
}

TEST_F(FoodMeshTest, SaysWhatIsMissing) {
  EXPECT_EQ(build().code(), StatusCode::no_food_label);
  labels_(cv::Rect(100, 100, 30, 30)) = std::uint8_t{2};
  depth_ = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(build().code(), StatusCode::too_little_depth);
  labels_ = cv::Mat1b(480, 700, std::uint8_t{2});
  EXPECT_EQ(build().code(), StatusCode::out_of_memory);
}

}  // namespace
}  // namespace traygauge::paper
