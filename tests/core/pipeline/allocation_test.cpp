#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>
#include <vector>

#include "simulator/capture/capture.hpp"
#include "tests/core/pipeline/allocation_trap.hpp"
#include "tests/core/pipeline/measuring_bench.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"

namespace traygauge {
namespace {

// From construction to a second result; every step's outcome.
struct Course {
  StatusCode construction = StatusCode::ok;
  StatusCode first_result = StatusCode::ok;
  StatusCode second_result = StatusCode::ok;
  double volume_ml = 0.0;
  int allocations = 0;
};

Course run_course(std::span<std::byte> block, const Configuration& configuration, const ViewInput& first,
                  const ViewInput& second) {
  Course course;
  arm_allocation_trap();
  Estimator estimator(block, configuration);
  course.construction = estimator.status().code();
  for (StatusCode* result : {&course.first_result, &course.second_result}) {
    static_cast<void>(estimator.add_view(first));
    static_cast<void>(estimator.add_view(second));
    const Measurement& measurement = estimator.estimate(7);
    *result = measurement.status.code();
    if (!measurement.items.empty()) course.volume_ml = measurement.items.front().volume_ml;
    estimator.reset();
  }
  course.allocations = disarm_allocation_trap();
  return course;
}

void expect_silent(const Course& course) {
  EXPECT_EQ(course.construction, StatusCode::ok);
  EXPECT_EQ(course.first_result, StatusCode::ok);
  EXPECT_EQ(course.second_result, StatusCode::ok);
  EXPECT_GT(course.volume_ml, 0.0);
  EXPECT_EQ(course.allocations, 0);
}

TEST(AllocationTrap, CatchesEveryWayToAllocate) {
  arm_allocation_trap();
  { const std::vector<int> numbers(100, 1); }
  EXPECT_EQ(disarm_allocation_trap(), 2);

  arm_allocation_trap();
  void* volatile block = std::malloc(10);
  block = std::realloc(block, 1000);
  std::free(block);
  block = std::calloc(10, 10);
  std::free(block);
  block = std::aligned_alloc(64, 128);
  std::free(block);
  void* other = nullptr;
  ASSERT_EQ(posix_memalign(&other, 64, 100), 0);
  std::free(other);
  EXPECT_EQ(disarm_allocation_trap(), 9);

  arm_allocation_trap();
  ::operator delete (::operator new (256, std::align_val_t{64}), std::align_val_t{64});
  EXPECT_EQ(disarm_allocation_trap(), 2);

  { const std::vector<int> numbers(100, 1); }  // disarmed
  EXPECT_EQ(disarm_allocation_trap(), 2);
}

TEST(Allocations, NoneFromConstructionToResultOnTheSyntheticTray) {
  const TrayScene& scene = default_tray();
  const Configuration configuration = scene.configuration();
  const TestBlock block(required_bytes(configuration));
  expect_silent(run_course(block.bytes(), configuration, scene.view(0), scene.view(1)));
}

TEST(Allocations, NoneWhenAMeasurementIsRefused) {
  const TrayScene& scene = default_tray();
  const Configuration configuration = scene.configuration();
  const TestBlock block(required_bytes(configuration));
  const Course course = run_course(block.bytes(), configuration, scene.view(0), other_tray().view(1));
  EXPECT_NE(course.first_result, StatusCode::ok);
  EXPECT_EQ(course.allocations, 0);
}

class AllocationsOfProfile : public testing::TestWithParam<Profile> {};
INSTANTIATE_TEST_SUITE_P(Both, AllocationsOfProfile, testing::Values(Profile::best, Profile::paper),
                         [](const auto& profile) {
                           return profile.param == Profile::best ? "Best" : "Paper";
                         });

TEST_P(AllocationsOfProfile, NoneOnACapture) {
  if (captures_folder().empty()) GTEST_SKIP() << "TRAYGAUGE_CAPTURES names no captures";
  const Capture capture = read_capture(captures_folder() / "meals" / "m01");
  const std::array<LoadedView, 2> views = {load_view(capture.views[0]), load_view(capture.views[1])};
  const Picture pattern = load_pattern(capture.card);
  const CameraDescription& camera = capture.views[0].camera;
  const auto& [k1, k2, p1, p2, k3] = camera.distortion;
  const DishDescription& dish = capture.dishes.front();
  const std::array<DishModel, 1> dishes = {
      DishModel{dish.outer_size_mm, dish.rim_height_mm, dish.bottom_height_mm}};
  Configuration configuration;
  configuration.profile = GetParam();
  configuration.lens = {camera.size.width,
                        camera.size.height,
                        {camera.fx_px, camera.fy_px, camera.cx_px, camera.cy_px},
                        k1,
                        k2,
                        p1,
                        p2,
                        k3};
  configuration.card = {capture.card.width_mm, capture.card.height_mm, capture.card.thickness_mm,
                        pattern.gray()};
  configuration.dishes = dishes;
  const TestBlock block(required_bytes(configuration));
  const auto input = [&](const LoadedView& view) {
    return ViewInput{view.picture.frame(), view.labels.gray(), {}, {}};
  };
  expect_silent(run_course(block.bytes(), configuration, input(views[0]), input(views[1])));
}

}  // namespace
}  // namespace traygauge
