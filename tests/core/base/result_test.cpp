#include "core/base/result.hpp"

#include <gtest/gtest.h>

#include <type_traits>

namespace traygauge {
namespace {

struct Fit {
  int inliers = 0;
  double rms_px = 0.0;
};

Result<Fit> fit_to(int points) {
  if (points < 3) return StatusCode::too_few_matches;
  return Fit{points, 0.5};
}

// Passes on why another one failed.
Result<double> rms_of(int points) {
  const Result<Fit> fit = fit_to(points);
  if (!fit.ok()) return fit.status();
  return fit->rms_px;
}

TEST(Result, HoldsAValue) {
  const Result<Fit> fit = fit_to(7);
  EXPECT_TRUE(fit.ok());
  EXPECT_TRUE(fit.status().ok());
  EXPECT_EQ(fit.code(), StatusCode::ok);
  EXPECT_EQ(fit->inliers, 7);
  EXPECT_EQ((*fit).inliers, 7);
  EXPECT_EQ(&fit.value(), &*fit);
  EXPECT_EQ(rms_of(7).value(), 0.5);
}

TEST(Result, HoldsARefusal) {
  const Result<Fit> fit = fit_to(2);
  EXPECT_FALSE(fit.ok());
  EXPECT_FALSE(fit.status().ok());
  EXPECT_EQ(fit.code(), StatusCode::too_few_matches);
  EXPECT_EQ(rms_of(2).code(), StatusCode::too_few_matches);
}

TEST(Result, IsKnownWhenCompiling) {
  static_assert(*Result<int>(3) == 3);
  static_assert(Result<int>(StatusCode::card_hidden).code() == StatusCode::card_hidden);
  static_assert(!std::is_default_constructible_v<Result<int>>, "it would be neither");
  static_assert(std::is_trivially_copyable_v<Result<Fit>>);
}

// Builds without assertions only run the statements.
TEST(Result, AssertsWhatItPromises) {
  EXPECT_DEBUG_DEATH(static_cast<void>(Result<Fit>(StatusCode::ok)), "ok");
  EXPECT_DEBUG_DEATH(static_cast<void>(*fit_to(2)), "ok");
  EXPECT_DEBUG_DEATH(static_cast<void>(fit_to(2)->inliers), "ok");
  EXPECT_DEBUG_DEATH(static_cast<void>(fit_to(2).value()), "ok");
}

}  // namespace
}  // namespace traygauge
