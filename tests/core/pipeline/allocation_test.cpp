#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

#ifdef TRAYGAUGE_HAS_PAPER
#include "core/paper/pipeline/estimator.hpp"
#endif
#include "tests/core/pipeline/allocation_trap.hpp"
#include "tests/core/pipeline/demo_tray.hpp"
#include "tests/core/pipeline/measuring_bench.hpp"

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

template <class Estimator, class Config>
Course run_course(const Config& configuration, const ViewInput& first, const ViewInput& second) {
  const TestBlock memory(required_bytes(configuration));
  const std::span<std::byte> block = memory.bytes();
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

TEST(Allocations, NoneWithGivenLabels) {
  const DemoTray demo;
  expect_silent(run_course<TrayEstimator>(demo.configuration(), demo.view(0), demo.view(1)));
}

TEST(Allocations, NoneWhereLabelsAreFound) {
  const DemoTray demo;
  expect_silent(run_course<TrayEstimator>(demo.configuration(), demo.bare_view(0), demo.bare_view(1)));
}

TEST(Allocations, NoneWhenAMeasurementIsRefused) {
  const DemoTray demo;
  const Course course = run_course<TrayEstimator>(demo.configuration(), demo.view(0), demo.view(0));
  EXPECT_NE(course.first_result, StatusCode::ok);
  EXPECT_EQ(course.allocations, 0);
}

#ifdef TRAYGAUGE_HAS_PAPER
TEST(Allocations, NoneInProfilePaper) {
  const DemoTray demo;
  expect_silent(
      run_course<paper::Estimator>(demo.configuration<paper::Configuration>(), demo.view(0), demo.view(1)));
}
#endif

}  // namespace
}  // namespace traygauge
