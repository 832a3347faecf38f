#include "simulator/scenes/dish_shell.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "simulator/capture/capture.hpp"
#include "simulator/capture/picture_file.hpp"
#include "simulator/capture/truth.hpp"
#include "simulator/render/lens.hpp"

namespace traygauge {
namespace {

constexpr double kDepthUnitMm = 0.02;

// Another renderer's depth of the empty parts of its dishes lies on our inner surface.
class DishOfAnotherRenderer : public testing::TestWithParam<const char*> {};

TEST_P(DishOfAnotherRenderer, IsTheSame) {
  const char* captures = std::getenv("TRAYGAUGE_CAPTURES");
  if (captures == nullptr) GTEST_SKIP() << "TRAYGAUGE_CAPTURES names no folder";
  const std::filesystem::path folder = std::filesystem::path(captures) / GetParam();
  const Capture capture = read_capture(folder);
  const Truth truth = *read_truth(folder);
  const ViewDescription& view = capture.views.front();
  const Picture labels = read_label_picture(*view.labels, view.camera.size);
  const DepthPicture depth = read_depth_picture({folder / "depth_0.png", ""}, view.camera.size);

  ViewCamera camera;
  camera.width = view.camera.size.width;
  camera.height = view.camera.size.height;
  camera.fx = view.camera.fx_px;
  camera.fy = view.camera.fy_px;
  camera.cx = view.camera.cx_px;
  camera.cy = view.camera.cy_px;
  camera.distortion = view.camera.distortion;
  const Lens lens(camera);
  Eigen::Isometry3d camera_from_world = Eigen::Isometry3d::Identity();
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (Eigen::Index k = 0; k < 4; ++k)
      camera_from_world(i, k) = truth.poses[0][static_cast<std::size_t>(i)][static_cast<std::size_t>(k)];
  }
  const DishShell shell(capture.dishes.front());
  std::vector<double> errors;
  for (int y = 0; y < camera.height; y += 3) {
    for (int x = 0; x < camera.width; x += 3) {
      if (labels.gray().at(x, y) != 1) continue;
      const Eigen::Vector2d direction = lens.direction_of({x, y});
      const double z = kDepthUnitMm * depth.view().at(x, y);
      const Eigen::Vector3d at =
          camera_from_world.inverse() * Eigen::Vector3d(z * direction.x(), z * direction.y(), z);
      if (!shell.contains(at.x(), at.y(), 3.0)) continue;  // the edge, and the wall outside
      errors.push_back(std::abs(at.z() - shell.inner_height_mm(at.x(), at.y())));
    }
  }
  ASSERT_GT(errors.size(), 5000U);
  std::sort(errors.begin(), errors.end());
  EXPECT_LT(errors[errors.size() / 2], 0.03);
  EXPECT_LT(errors[errors.size() * 99 / 100], 0.12);
}

INSTANTIATE_TEST_SUITE_P(Captures, DishOfAnotherRenderer,
                         testing::Values("plates/c1_dinner", "plates/c1_soup", "plates/c1_oval",
                                         "meals/m01"));

TEST(DishShell, InsetOfAnOvalSolvesItsCurve) {
  DishDescription dish;
  dish.outer_size_mm = {300.0, 210.0};
  dish.rim_height_mm = 24.0;
  dish.bottom_height_mm = 4.0;
  dish.profile = {{0.0, 24.0}, {38.0, 4.0}};
  const DishShell shell(dish);
  for (double inset = -5.0; inset < 38.0; inset += 1.7) {
    for (double angle = 0.0; angle < 6.3; angle += 0.37) {
      const double found =
          shell.inset_mm((150.0 - inset) * std::cos(angle), (105.0 - inset) * std::sin(angle));
      EXPECT_NEAR(found, inset, 1e-6) << inset << " at " << angle;
    }
  }
  EXPECT_DOUBLE_EQ(shell.inset_mm(0.0, 0.0), 38.0);
}

}  // namespace
}  // namespace traygauge
