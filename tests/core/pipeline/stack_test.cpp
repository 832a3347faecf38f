#include <gtest/gtest.h>
#include <pthread.h>

#include <algorithm>
#include <cstdio>
#include <vector>

#include "tests/core/pipeline/demo_tray.hpp"
#include "tests/core/pipeline/measuring_bench.hpp"

namespace traygauge {
namespace {

constexpr std::size_t kStackBytes = std::size_t{1} << 20U;
constexpr std::size_t kMaxUsedBytes = std::size_t{256} << 10U;
constexpr unsigned char kPaint = 0xC7;

// Runs `work` on a painted stack and returns how deep the paint was scratched (stacks grow downwards).
std::size_t measure_stack(void* (*work)(void*), void* argument) {
  const std::size_t alignment = 1U << 16U;
  auto* stack = static_cast<unsigned char*>(::operator new (kStackBytes, std::align_val_t{alignment}));
  std::fill_n(stack, kStackBytes, kPaint);
  pthread_attr_t attributes;
  pthread_t thread{};
  EXPECT_EQ(pthread_attr_init(&attributes), 0);
  EXPECT_EQ(pthread_attr_setstack(&attributes, stack, kStackBytes), 0);
  EXPECT_EQ(pthread_create(&thread, &attributes, work, argument), 0);
  EXPECT_EQ(pthread_join(thread, nullptr), 0);
  pthread_attr_destroy(&attributes);
  const unsigned char* touched =
      std::find_if(stack, stack + kStackBytes, [](unsigned char byte) { return byte != kPaint; });
  const auto used = static_cast<std::size_t>(stack + kStackBytes - touched);
  ::operator delete (stack, std::align_val_t{alignment});
  return used;
}

void* do_nothing(void*) {
  return nullptr;
}

void* fill_64_kib(void*) {
  volatile unsigned char bytes[64 << 10];
  for (volatile unsigned char& byte : bytes) byte = 1;
  return nullptr;
}

template <class Estimator, class Config>
struct Job {
  const Config* configuration = nullptr;
  std::span<std::byte> block;
  std::array<ViewInput, 2> views;
  StatusCode status = StatusCode::ok;

  static void* measure(void* argument) {
    Job& job = *static_cast<Job*>(argument);
    Estimator estimator(job.block, *job.configuration);
    for (const ViewInput& view : job.views) static_cast<void>(estimator.add_view(view));
    job.status = estimator.estimate(5).status.code();
    return nullptr;
  }
};

template <class Estimator, class Config>
void expect_shallow(const Config& configuration, std::array<ViewInput, 2> views,
                    StatusCode status = StatusCode::ok) {
  const TestBlock block(required_bytes(configuration));
  Job<Estimator, Config> job{&configuration, block.bytes(), views};
  const std::size_t used = measure_stack(Job<Estimator, Config>::measure, &job);
  EXPECT_EQ(job.status, status) << name(job.status);
  std::printf("stack: %zu KiB, of which %zu KiB are the thread's own\n", used >> 10U,
              measure_stack(do_nothing, nullptr) >> 10U);
  EXPECT_LE(used, kMaxUsedBytes);
}

TEST(Stack, TheMeasureSeesAFunctionsFrame) {
  const std::size_t idle = measure_stack(do_nothing, nullptr);
  const std::size_t used = measure_stack(fill_64_kib, nullptr);
  EXPECT_GE(used, idle + (std::size_t{60} << 10U));
  EXPECT_LE(used, idle + (std::size_t{80} << 10U));
}

TEST(Stack, AMeasurementStaysWithin256KiB) {
  const DemoTray demo;
  expect_shallow<TrayEstimator>(demo.configuration(), {demo.view(0), demo.view(1)});
}

TEST(Stack, TryingOtherLensesStaysWithin256KiB) {
  const DemoTray demo;
  auto configuration = demo.configuration();
  configuration.lens = LensChange{0.9}.of(configuration.lens);
  expect_shallow<TrayEstimator>(configuration, {demo.view(0), demo.view(1)}, StatusCode::lens_does_not_fit);
}

TEST(Stack, FindingLabelsStaysWithin256KiB) {
  const DemoTray demo;
  expect_shallow<TrayEstimator>(demo.configuration(), {demo.bare_view(0), demo.bare_view(1)});
}

}  // namespace
}  // namespace traygauge
