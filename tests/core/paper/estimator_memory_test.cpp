#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/base/random.hpp"
#include "core/paper/pipeline/estimator_memory.hpp"
#include "core/paper/pipeline/feature_preparation.hpp"
#include "tests/core/paper/paper_bench.hpp"

namespace traygauge::paper {
namespace {

constexpr std::size_t kBudgetBytes = std::size_t{32} << 20U;  // at 1600 × 1200, the default
constexpr std::byte kGuard{0x5C};

static_assert(planned_bytes({}) > 0);
static_assert(planned_bytes({}) + (std::size_t{96} << 10U) <= kBudgetBytes,
              "96 KiB are for the state at the head of the block");

TEST(EstimatorMemory, DefaultStaysWithinTheBudget) {
  EXPECT_LE(required_bytes({}), kBudgetBytes);
  EXPECT_LE(required_bytes({}) - planned_bytes({}), std::size_t{96} << 10U);
}

TEST(EstimatorMemory, RowsAddUp) {
  for (const int width : {1600, 640}) {
    Configuration configuration;
    configuration.limits.max_frame_width = width;
    std::size_t kept = 0;
    std::size_t largest_shared = 0;
    for (const MemoryRow& row : describe_memory(configuration)) {
      EXPECT_GT(row.bytes, 0U) << row.name;
      if (row.shared) {
        largest_shared = std::max(largest_shared, row.bytes);
      } else {
        kept += row.bytes;
      }
    }
    EXPECT_EQ(kept + largest_shared, required_bytes(configuration));
  }
}

TEST(EstimatorMemory, MoreOfACapTakesMoreMemory) {
  const auto bytes = [](auto change) {
    Configuration configuration;
    change(configuration);
    return required_bytes(configuration);
  };
  const std::size_t normal = bytes([](Configuration&) {});
  EXPECT_GT(bytes([](Configuration& c) { c.caps.max_keypoints *= 2; }), normal);
  EXPECT_GT(bytes([](Configuration& c) { c.caps.max_pattern_keypoints *= 2; }), normal);
  EXPECT_GT(bytes([](Configuration& c) { c.caps.max_working_px *= 2; }), normal);
  EXPECT_GT(bytes([](Configuration& c) { c.rectification.max_rows *= 2; }), normal);
}

TEST(EstimatorMemory, ABlockThatIsTooSmallIsOutOfMemory) {
  const TrayScene& scene = default_tray();
  const Configuration configuration = configuration_of(scene);
  const std::size_t enough = required_bytes(configuration);
  const TestBlock block(enough);
  for (const std::size_t size :
       {enough - 1, enough / 2, std::size_t{4096}, std::size_t{64}, std::size_t{0}}) {
    Estimator estimator(block.bytes().first(size), configuration);
    EXPECT_EQ(estimator.status().code(), StatusCode::out_of_memory) << size;
    EXPECT_EQ(estimator.add_view(scene.view(0)).code(), StatusCode::out_of_memory);
    EXPECT_EQ(estimator.estimate(1).status.code(), StatusCode::out_of_memory);
    EXPECT_TRUE(estimator.estimate(1).items.empty());
    estimator.reset();
    EXPECT_EQ(estimator.used_bytes(), 0U);
  }
  EXPECT_TRUE(Estimator(block.bytes(), configuration).status().ok());
}

TEST(EstimatorMemory, NothingIsWrittenBehindTheBlock) {
  constexpr std::size_t kGuardBytes = std::size_t{1} << 20U;
  const TrayScene& scene = default_tray();
  const Configuration configuration = configuration_of(scene);
  const std::size_t size = required_bytes(configuration);
  const TestBlock block(size + kGuardBytes);
  std::fill(block.bytes().begin() + static_cast<std::ptrdiff_t>(size), block.bytes().end(), kGuard);
  Estimator estimator(block.bytes().first(size), configuration);
  for (const int i : {0, 1}) ASSERT_TRUE(estimator.add_view(scene.view(i)).ok());
  ASSERT_TRUE(estimator.estimate(1).status.ok());
  EXPECT_EQ(estimator.used_bytes(), size);
  const auto guard = block.bytes().subspan(size);
  EXPECT_TRUE(std::all_of(guard.begin(), guard.end(), [](std::byte byte) { return byte == kGuard; }));
}

// A pattern or a card's picture of odd proportions must not outgrow the memory for searching.
TEST(EstimatorMemory, LongAndLargePatternsFit) {
  const TrayScene& scene = default_tray();
  for (const auto& [width, height] : {std::pair{4000, 4000}, {64, 8000}, {8000, 64}, {514, 324}}) {
    const std::vector<std::uint8_t> pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                                           90);
    Configuration configuration = configuration_of(scene);
    configuration.card.width_mm = 500.0;
    configuration.card.height_mm = 500.0;
    configuration.card.pattern = {pixels.data(), width, height};
    const TestBlock block(required_bytes(configuration));
    EXPECT_TRUE(Estimator(block.bytes(), configuration).status().ok()) << width << " x " << height;
  }
}

TEST(EstimatorMemory, APatternLargerThanASmallFrameFits) {
  const TrayScene& scene = default_tray();
  Configuration configuration = configuration_of(scene);
  configuration.limits.max_frame_width = 64;
  configuration.limits.max_frame_height = 48;
  configuration.caps.max_feature_px = 64 * 48;
  const TestBlock block(required_bytes(configuration));
  EXPECT_TRUE(Estimator(block.bytes(), configuration).status().ok());
}

// Whatever is searched (frame, pattern, a card's label of any shape), its picture and sums fit the memory.
TEST(EstimatorMemory, SearchPicturesFitTheirMemory) {
  constexpr std::uint64_t kSeed = 20;
  Random random(kSeed);
  for (int round = 0; round < 10000; ++round) {
    Configuration configuration;
    FrameLimits& limits = configuration.limits;
    Caps& caps = configuration.caps;
    limits.max_frame_width = 16 + static_cast<int>(random.below(3000));
    limits.max_frame_height = 16 + static_cast<int>(random.below(3000));
    caps.max_feature_px = 64 + static_cast<int>(random.below(2000000));
    const int width = 1 + static_cast<int>(random.below(8192));
    const int height = 1 + static_cast<int>(random.below(8192));
    const double wanted = 0.05 + random.below(1000) / 300.0;
    const double scale = fit_search_scale(wanted, width, height, configuration);
    const auto scaled_width = static_cast<std::size_t>(width * scale);
    const auto scaled_height = static_cast<std::size_t>(height * scale);
    const auto pixels = static_cast<std::size_t>(caps.max_feature_px);
    const auto sums = pixels + static_cast<std::size_t>(limits.max_frame_width + limits.max_frame_height + 1);
    ASSERT_LE(scale, wanted) << "seed " << kSeed << " round " << round;
    ASSERT_LE(scaled_width * scaled_height, pixels) << "seed " << kSeed << " round " << round;
    ASSERT_LE((scaled_width + 1) * (scaled_height + 1), sums) << "seed " << kSeed << " round " << round;
    ASSERT_LE(scaled_width, static_cast<std::size_t>(limits.max_frame_width));
  }
}

}  // namespace
}  // namespace traygauge::paper
