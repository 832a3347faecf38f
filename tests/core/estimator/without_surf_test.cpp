// The core library as it is where SURF is not built: profile paper is refused, by name.
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "core/base/arena.hpp"
#include "core/estimator/estimator.hpp"
#include "core/features/has_surf.hpp"

namespace traygauge {
namespace {

TEST(WithoutSurf, TheEstimatorOfProfilePaperIsRefused) {
  constexpr int kPatternPx = 64;
  const std::vector<std::uint8_t> pattern(kPatternPx * kPatternPx);
  const std::array<DishModel, 1> dishes = {DishModel{{260.0, 260.0}, 22.0, 4.5}};
  Configuration configuration;
  configuration.profile = Profile::paper;
  configuration.lens = {1600, 1200, {1200.0, 1200.0, 800.0, 600.0}};
  configuration.card.pattern = {pattern.data(), kPatternPx, kPatternPx};
  configuration.dishes = dishes;
  alignas(kArenaAlignmentBytes) std::array<std::byte, 1024> block{};
  Estimator estimator(block, configuration);
  EXPECT_FALSE(has_surf());
  EXPECT_STREQ(name(estimator.status().code()), "surf_not_built");
  EXPECT_EQ(estimator.add_view({}).code(), StatusCode::surf_not_built);
  EXPECT_EQ(estimator.estimate(1).status.code(), StatusCode::surf_not_built);
}

}  // namespace
}  // namespace traygauge
