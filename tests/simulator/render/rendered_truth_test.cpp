// Labels and depth against closed forms, and pictures against labels: where an edge is, there it is seen.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <opencv2/calib3d.hpp>
#include <optional>
#include <vector>

#include "simulator/render/camera_rays.hpp"
#include "simulator/render/view_renderer.hpp"
#include "tests/simulator/render/opencv_view_camera.hpp"
#include "tests/simulator/render/render_scenes.hpp"

namespace traygauge {
namespace {

// Directions of all pixels by OpenCV, z = 1.
std::vector<Eigen::Vector3d> directions_of(const ViewCamera& camera) {
  std::vector<cv::Point2d> pixels;
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) pixels.emplace_back(x, y);
  }
  std::vector<cv::Point2d> undistorted;
  cv::undistortPoints(pixels, undistorted, matrix_of(camera), coefficients_of(camera), cv::noArray(),
                      cv::noArray(),
                      cv::TermCriteria(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 200, 1e-13));
  std::vector<Eigen::Vector3d> directions;
  for (const cv::Point2d& point : undistorted) directions.emplace_back(point.x, point.y, 1.0);
  return directions;
}

Eigen::Vector2d project(const ViewCamera& camera, const Eigen::Isometry3d& pose,
                        const Eigen::Vector3d& point_mm) {
  const Eigen::Vector3d seen = pose * point_mm;
  std::vector<cv::Point2d> pixels;
  cv::projectPoints(std::vector<cv::Point3d>{{seen.x(), seen.y(), seen.z()}}, cv::Vec3d(), cv::Vec3d(),
                    matrix_of(camera), coefficients_of(camera), pixels);
  return {pixels[0].x, pixels[0].y};
}

// Of origin + s · direction with a sphere: the nearer s.
std::optional<double> meet_sphere(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                  const Eigen::Vector3d& center, double radius) {
  const Eigen::Vector3d from_center = origin - center;
  const double a = direction.squaredNorm();
  const double b = direction.dot(from_center);
  const double root2 = b * b - a * (from_center.squaredNorm() - radius * radius);
  if (root2 < 0.0) return std::nullopt;
  return (-b - std::sqrt(root2)) / a;
}

TEST(RenderedTruth, LabelsAndDepthOfPlaneAndSphereUnderDistortion) {
  Scene scene;
  scene.objects.push_back({square(600.0F, 0.0F), matt(0.5F), 7});
  scene.objects.push_back({sphere({20.0F, 10.0F, 30.0F}, 60.0F, 1000), matt(0.5F), 3});
  ViewCamera camera = camera_at({80.0, -350.0, 380.0}, {0.0, 0.0, 0.0}, 200, 150, 150.0);
  camera.distortion = {-0.25, 0.08, 0.002, -0.003, -0.01};
  const RenderedView view = ViewRenderer(scene).render(camera);
  const Eigen::Isometry3d pose = camera.camera_from_world.inverse();
  const std::vector<Eigen::Vector3d> directions = directions_of(camera);
  int wrong_labels = 0;
  double worst_plane_mm = 0.0;
  double worst_sphere_mm = 0.0;
  int nothing = 0;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const Eigen::Vector3d direction = pose.linear() * directions[i];
    const auto sphere_depth = meet_sphere(pose.translation(), direction, {20.0, 10.0, 30.0}, 60.0);
    const double plane_depth = -pose.translation().z() / direction.z();
    const Eigen::Vector3d on_plane = pose.translation() + plane_depth * direction;
    const bool is_plane = on_plane.head<2>().cwiseAbs().maxCoeff() < 300.0;
    const int label = sphere_depth && *sphere_depth < plane_depth ? 3 : is_plane ? 7 : 0;
    if (view.labels[i] != label) {
      ++wrong_labels;
      continue;
    }
    const auto depth = static_cast<double>(view.depth_mm[i]);
    if (label == 3) worst_sphere_mm = std::max(worst_sphere_mm, std::abs(depth - *sphere_depth));
    if (label == 7) worst_plane_mm = std::max(worst_plane_mm, std::abs(depth - plane_depth));
    if (label == 0) {
      ++nothing;
      EXPECT_EQ(view.depth_mm[i], 0.0F);
    }
  }
  EXPECT_LE(wrong_labels, 3);  // on a silhouette, where the sphere's triangles lie within
  EXPECT_GT(nothing, 100);
  EXPECT_LT(worst_plane_mm, 5e-4);
  EXPECT_LT(worst_sphere_mm, 0.02);  // its triangles lie up to 3e-4 mm within, more along a grazing ray
}

// A white quad over black, lit by an even room: brightness is the share of a pixel's weight that the quad
// covers. Its left edge is slanted and runs off the picture.
// A pane over half of a table, with food below a part of it: the pane is named except before food, and passes
// what its tint and its mirror leave.
TEST(RenderedTruth, ClearGlassIsNamedUnlessFoodLiesBehindIt) {
  Scene scene;
  scene.ambient = Eigen::Vector3f::Ones();
  scene.objects.push_back({square(2000.0F, 0.0F), matt(0.5F), 0, TruthKind::table});
  scene.objects.push_back(
      {quad({0.0F, 20.0F, 20.0F}, {60.0F, 0.0F, 0.0F}, {0.0F, 60.0F, 0.0F}), matt(0.5F), 2, TruthKind::food});
  SceneObject pane{quad({0.0F, -200.0F, 60.0F}, {200.0F, 0.0F, 0.0F}, {0.0F, 400.0F, 0.0F}), matt(0.9F), 201,
                   TruthKind::glaze};
  pane.is_clear = true;
  scene.objects.push_back(pane);
  const ViewCamera camera = camera_at({0.0, 0.0, 400.0}, {0.0, 0.0, 0.0}, 80, 60, 100.0);
  const RenderedView view = ViewRenderer(scene).render(camera);
  int panes = 0;
  int foods = 0;
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 80; ++x) {
      const auto at = static_cast<std::size_t>(80 * y + x);
      if (x < 40) {
        EXPECT_EQ(view.kinds[at], TruthKind::table);
      } else if (view.kinds[at] == TruthKind::food) {
        EXPECT_EQ(view.labels[at], 2);
        ++foods;
      } else if (view.kinds[at] == TruthKind::glaze) {
        EXPECT_EQ(view.labels[at], 201);
        EXPECT_NEAR(view.depth_mm[at], 340.0F, 0.1F);
        ++panes;
      }
    }
  }
  EXPECT_GT(panes, 500);
  EXPECT_GT(foods, 100);
  // Far from the food: 0.96 of the light passes the surface, 0.9 of that its tint, 0.04 of the room is
  // mirrored.
  const auto bare = static_cast<std::size_t>(80 * 30 + 15);
  const auto behind = static_cast<std::size_t>(80 * 30 + 64);
  EXPECT_NEAR(view.radiance[behind].y(), 0.96F * 0.9F * view.radiance[bare].y() + 0.04F, 0.02F);
}

class SlantedEdge : public ::testing::Test {
 protected:
  static constexpr double kSlant = 0.137;
  static constexpr double kHeight_mm = 20.0;

  SlantedEdge() {
    scene_.ambient = Eigen::Vector3f::Ones();
    scene_.objects.push_back({square(4000.0F, -200.0F), matt(0.0F), 0});
    const auto at = [](double y) { return static_cast<float>(kSlant * y + 3.3); };
    scene_.objects.push_back({quad({at(-500.0), -500.0F, kHeight_mm}, {400.0F, 0.0F, 0.0F},
                                   {at(500.0) - at(-500.0), 1000.0F, 0.0F}),
                              matt(1.0F), 1});
    camera_ = camera_at({0.0, -60.0, 420.0}, {0.0, 0.0, 20.0}, 120, 160, 300.0);
  }

  // Column of the edge in a row of pixels, by bisection on the projected edge.
  double edge_column(const Eigen::Isometry3d& pose, int row) const {
    double near = -500.0;
    double far = 500.0;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (near + far);
      (project(camera_, pose, {kSlant * middle + 3.3, middle, kHeight_mm}).y() > row ? near : far) = middle;
    }
    return project(camera_, pose, {kSlant * near + 3.3, near, kHeight_mm}).x();
  }

  struct Offset {
    double picture_px = 0.0;
    double labels_px = 0.0;
    double worst_row_px = 0.0;
  };

  // White covers all pixels to the right of the edge, so their sum tells where the edge is.
  Offset measure(const Eigen::Isometry3d& pose) const {
    RenderSettings settings;
    settings.samples = 32;
    const RenderedView view = ViewRenderer(scene_).render(camera_, settings);
    Offset offset;
    for (int y = 0; y < view.height; ++y) {
      double white = 0.0;
      int labelled = 0;
      for (int x = 0; x < view.width; ++x) {
        const auto at = static_cast<std::size_t>(y * view.width + x);
        white += static_cast<double>(view.radiance[at].x());
        labelled += view.labels[at];
      }
      const double expected = edge_column(pose, y);
      const double row_px = view.width - 0.5 - white - expected;
      offset.picture_px += row_px / view.height;
      offset.labels_px += (view.width - 0.5 - labelled - expected) / view.height;
      offset.worst_row_px = std::max(offset.worst_row_px, std::abs(row_px));
    }
    std::cout << "picture " << offset.picture_px << " px, labels " << offset.labels_px << " px, worst row "
              << offset.worst_row_px << " px\n";
    return offset;
  }

  Scene scene_;
  ViewCamera camera_;
};

TEST_F(SlantedEdge, IsSeenWhereItIs) {
  const Offset offset = measure(camera_.camera_from_world);
  EXPECT_LT(std::abs(offset.picture_px), 0.01);
  EXPECT_LT(std::abs(offset.labels_px), 0.02);
  EXPECT_LT(offset.worst_row_px, 0.15);
}

TEST_F(SlantedEdge, IsSeenWhereItIsUnderDistortion) {
  camera_.distortion = {-0.3, 0.1, 0.003, -0.004, 0.0};
  const Offset offset = measure(camera_.camera_from_world);
  EXPECT_LT(std::abs(offset.picture_px), 0.01);
  EXPECT_LT(std::abs(offset.labels_px), 0.02);
}

TEST_F(SlantedEdge, StaysInPlaceOutOfFocus) {
  camera_.aperture_mm = 8.0;
  camera_.focus_mm = 300.0;
  const Offset offset = measure(camera_.camera_from_world);
  EXPECT_LT(std::abs(offset.picture_px), 0.02);
  EXPECT_LT(std::abs(offset.labels_px), 0.02);
}

TEST_F(SlantedEdge, StaysInTheMiddleOfAMotion) {
  camera_.moves = true;
  camera_.camera_from_world_at_end = look_at({6.0, -57.0, 418.0}, {5.0, 1.0, 20.0});
  const Eigen::Isometry3d middle = pose_in_exposure(camera_, 0.5);
  const double path_px =
      edge_column(camera_.camera_from_world_at_end, 80) - edge_column(camera_.camera_from_world, 80);
  EXPECT_GT(std::abs(path_px), 2.0);
  const Offset offset = measure(middle);
  EXPECT_LT(std::abs(offset.picture_px), 0.02);
  EXPECT_LT(std::abs(offset.labels_px), 0.02);
}

// The blur of a point out of focus is the picture of the pupil: of diameter f · aperture · |1/depth -
// 1/focus|.
TEST_F(SlantedEdge, IsAsWideAsThePupilOutOfFocus) {
  camera_.aperture_mm = 8.0;
  camera_.focus_mm = 300.0;
  RenderSettings settings;
  settings.samples = 256;
  const RenderedView view = ViewRenderer(scene_).render(camera_, settings);
  // Around its centre an edge under blur has the second moment of the blur across it: ∫ 2 |t| min(white, 1 -
  // white).
  double square = 0.0;
  int rows = 0;
  for (int y = 60; y < 100; ++y, ++rows) {
    const double center = edge_column(camera_.camera_from_world, y);
    for (int x = 0; x < view.width; ++x) {
      const auto white = static_cast<double>(view.radiance[static_cast<std::size_t>(y * view.width + x)].x());
      square += 2.0 * std::abs(x - center) * (x < center ? white : 1.0 - white);
    }
  }
  const double depth_mm = (camera_.camera_from_world * Eigen::Vector3d(0.0, 0.0, kHeight_mm)).z();
  const double diameter_px = camera_.fx * 8.0 * std::abs(1.0 / depth_mm - 1.0 / 300.0);
  // A disc's variance along a line is diameter²/16; the tent's 1/6; a row cuts the edge at its slant.
  const double expected = (diameter_px * diameter_px / 16.0 + 1.0 / 6.0) * (1.0 + kSlant * kSlant);
  EXPECT_GT(diameter_px, 2.0);
  EXPECT_NEAR(square / rows / expected, 1.0, 0.05) << "diameter " << diameter_px << " px";
}

TEST(CameraMotion, TurnsAndMovesEvenly) {
  ViewCamera camera;
  camera.camera_from_world = look_at({0.0, -300.0, 400.0}, {0.0, 0.0, 0.0});
  camera.camera_from_world_at_end = look_at({4.0, -302.0, 396.0}, {3.0, 0.0, 0.0});
  EXPECT_TRUE(pose_in_exposure(camera, 0.7).isApprox(camera.camera_from_world));
  camera.moves = true;
  EXPECT_TRUE(pose_in_exposure(camera, 0.0).isApprox(camera.camera_from_world, 1e-12));
  EXPECT_TRUE(pose_in_exposure(camera, 1.0).isApprox(camera.camera_from_world_at_end, 1e-12));
  const Eigen::Isometry3d middle = pose_in_exposure(camera, 0.5);
  EXPECT_LT((middle.inverse().translation() - Eigen::Vector3d(2.0, -301.0, 398.0)).norm(), 1e-9);
  const Eigen::AngleAxisd first(middle.linear() * camera.camera_from_world.linear().transpose());
  const Eigen::AngleAxisd second(camera.camera_from_world_at_end.linear() * middle.linear().transpose());
  EXPECT_TRUE(first.isApprox(second, 1e-9));
}

}  // namespace
}  // namespace traygauge
