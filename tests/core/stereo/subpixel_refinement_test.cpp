// Subpixel refinement on pictures of a known function, so that every disparity is known exactly.
#include "core/stereo/subpixel_refinement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "core/base/arena.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

constexpr int kWidth = 200;
constexpr int kHeight = 80;

double texture(double x, double y) {
  return 120.0 + 35.0 * std::sin(0.9 * x + 0.3 * y) + 25.0 * std::sin(0.51 * x - 0.7 * y + 1.0) +
         20.0 * std::sin(0.23 * x + 1.1 * y);
}

// A pair that shows `disparity(x, y)` from the second picture, brightness changed in the first.
struct Pair {
  std::vector<std::uint8_t> first = std::vector<std::uint8_t>(kWidth * kHeight);
  std::vector<std::uint8_t> second = first;
  std::vector<std::uint8_t> labels = std::vector<std::uint8_t>(kWidth * kHeight, 2);
  std::vector<std::uint8_t> trusted = std::vector<std::uint8_t>(kWidth * kHeight, 1);
  std::vector<float> surface = std::vector<float>(kWidth * kHeight);
  std::function<double(int, int)> disparity;

  Pair(std::function<double(int, int)> truth, double start_error_px, unsigned seed) : disparity(truth) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> error(-start_error_px, start_error_px);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const auto i = static_cast<std::size_t>(y * kWidth + x);
        first[i] = static_cast<std::uint8_t>(std::lround(texture(x + truth(x, y), y) + 12.0));
        second[i] = static_cast<std::uint8_t>(std::lround(texture(x, y)));
        surface[i] = static_cast<float>(std::lround(truth(x, y) + error(random)));
      }
    }
  }
  template <class T>
  static ImageView<T> view(std::vector<T>& pixels) {
    return {pixels.data(), kWidth, kHeight};
  }
  void refine(const SubpixelRefinementParams& params = {}) {
    ArenaPlan plan;
    SubpixelRefinementWorkspace workspace;
    workspace.allocate(plan, kWidth, kWidth * kHeight);
    std::vector<std::byte> block(plan.high_water_bytes() + kArenaAlignmentBytes);
    const auto raw = reinterpret_cast<std::uintptr_t>(block.data());
    const auto aligned = (raw + kArenaAlignmentBytes - 1) / kArenaAlignmentBytes * kArenaAlignmentBytes;
    Arena arena({block.data() + (aligned - raw), plan.high_water_bytes()});
    workspace.allocate(arena, kWidth, kWidth * kHeight);
    ASSERT_FALSE(arena.exhausted());
    refine_surface({view(first), view(labels), view(second), view(labels), 1}, view(trusted), params,
                   workspace, view(surface));
  }
  // Median of the absolute errors and mean of the signed ones, away from the borders.
  std::pair<double, double> errors() const {
    std::vector<double> magnitudes;
    double sum = 0.0;
    for (int y = 6; y < kHeight - 6; ++y) {
      for (int x = 6; x < kWidth - 30; ++x) {
        const double error = surface[static_cast<std::size_t>(y * kWidth + x)] - disparity(x, y);
        magnitudes.push_back(std::abs(error));
        sum += error;
      }
    }
    std::sort(magnitudes.begin(), magnitudes.end());
    return {magnitudes[magnitudes.size() / 2], sum / static_cast<double>(magnitudes.size())};
  }
};

TEST(SurfaceRefinement, FindsSubpixelShiftsOfSlantedAndCurvedSurfaces) {
  const unsigned seed = test::random_seed();
  const auto flat = [](int, int) { return 7.37; };
  const auto slanted = [](int x, int y) { return 4.0 + 0.08 * x - 0.02 * y; };
  const auto curved = [](int x, int y) { return 5.0 + 3.0 * std::sin(0.03 * x) + 2.0 * std::cos(0.05 * y); };
  for (const std::function<double(int, int)>& truth :
       {std::function<double(int, int)>(flat), std::function<double(int, int)>(slanted),
        std::function<double(int, int)>(curved)}) {
    Pair pair(truth, 0.3, seed);
    const double before = pair.errors().first;
    pair.refine();
    const auto [median, bias] = pair.errors();
    EXPECT_LT(median, 0.05);
    EXPECT_LT(median, 0.4 * before);
    EXPECT_LT(std::abs(bias), 0.01);
  }
}

TEST(SurfaceRefinement, SamplesWithoutPartnersFollowTheirNeighbours) {
  Pair pair([](int x, int) { return 4.0 + 0.05 * x; }, 0.0, 1);
  for (int y = 32; y < 38; ++y) {
    for (int x = 82; x < 88; ++x) {
      const auto i = static_cast<std::size_t>(y * kWidth + x);
      pair.trusted[i] = 0;
      pair.first[i] = 0;
      pair.surface[i] += 0.9F;
    }
  }
  SubpixelRefinementParams params;
  params.relaxations = 60;
  pair.refine(params);
  EXPECT_NEAR(pair.surface[35 * kWidth + 85], 4.0 + 0.05 * 85, 0.25);
}

TEST(SurfaceRefinement, PlainPicturesAndWildDisparitiesStayFinite) {
  Pair pair([](int, int) { return 3.0; }, 0.0, 1);
  std::fill(pair.first.begin(), pair.first.end(), std::uint8_t{90});
  std::fill(pair.second.begin(), pair.second.end(), std::uint8_t{90});
  pair.surface[1000] = 1e6F;
  pair.surface[2000] = -1e6F;
  pair.refine();
  for (const float d : pair.surface) EXPECT_TRUE(std::isfinite(d));
}

}  // namespace
}  // namespace traygauge
