#include "firmware/verify/verify_figures.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/firmware/verify/sample_record.hpp"

namespace traygauge {
namespace {

// a, 100 ml: 102, 101, 99, 98 with sigma 1: errors +2, +1, -1, -2. b, 200 ml: 206, 206, 202, one refused
// twice: errors +3, +3, +1. Repeats of b: 200 and 204.
VerifyRecord table() {
  VerifyRecord record;
  record.header = sample_header();
  record.scans = {measured_scan("a-middle-0", 102.0),  measured_scan("a-middle-45", 101.0),
                  measured_scan("a-left-0", 99.0),     measured_scan("a-left-45", 98.0),
                  measured_scan("b-middle-0", 206.0),  refused_scan("b-middle-45"),
                  measured_scan("b-middle-45", 206.0), measured_scan("b-left-0", 202.0),
                  refused_scan("b-left-45"),           refused_scan("b-left-45"),
                  measured_scan("b-repeat-01", 200.0), measured_scan("b-repeat-02", 204.0)};
  record.scans[3].warnings = {"low_texture"};
  return record;
}

TEST(VerifyFigures, AreThoseOfTheTable) {
  const VerifyFigures figures = verify_figures(table());
  EXPECT_EQ(figures.steps, 10);
  EXPECT_EQ(figures.steps_done, 10);
  EXPECT_EQ(figures.steps_refused, 1);
  EXPECT_TRUE(figures.is_complete());
  EXPECT_EQ(figures.attempts, 12);
  EXPECT_EQ(figures.attempts_refused, 3);
  EXPECT_NEAR(figures.refused.value, 25.0, 1e-9);

  ASSERT_EQ(figures.bodies.size(), 2U);
  const BodyFigures& a = figures.bodies[0];
  EXPECT_EQ(a.scans, 4);
  EXPECT_NEAR(a.bias.value, 0.0, 1e-9);
  EXPECT_NEAR(a.mape.value, 1.5, 1e-9);
  EXPECT_NEAR(a.within_one.value, 50.0, 1e-9);
  EXPECT_NEAR(a.within_two.value, 100.0, 1e-9);
  EXPECT_EQ(std::abs(a.worst), 2.0);
  EXPECT_EQ(a.warned, 1);
  const BodyFigures& b = figures.bodies[1];
  EXPECT_EQ(b.scans, 3);
  EXPECT_NEAR(b.bias.value, 7.0 / 3.0, 1e-9);
  EXPECT_NEAR(b.within_one.value, 0.0, 1e-9);
  EXPECT_NEAR(b.within_two.value, 100.0 / 3.0, 1e-9);
  EXPECT_NEAR(b.worst, 3.0, 1e-9);

  // Each body weighs the same.
  EXPECT_NEAR(figures.bias.value, 7.0 / 6.0, 1e-9);
  EXPECT_NEAR(figures.mape.value, 0.5 * (1.5 + 7.0 / 3.0), 1e-9);
  EXPECT_NEAR(figures.within_two.value, 100.0 * 5.0 / 7.0, 1e-9);
  // 200 and 204: deviation sqrt(8) over a mean of 202.
  EXPECT_NEAR(figures.cv.value, 100.0 * std::sqrt(8.0) / 202.0, 1e-9);
  EXPECT_EQ(figures.repeats, 2);
  EXPECT_EQ(figures.worst_body()->body.id, "b");
}

// Student's: +2, +1, -1, -2 have a deviation of 1.826; t(3) = 3.182.
TEST(VerifyFigures, IntervalsGrowByTheBodysUncertainty) {
  VerifyRecord record = table();
  const VerifyFigures exact = verify_figures(record);
  EXPECT_NEAR(exact.bodies[0].bias.interval->high, 3.1824 * 1.8257 / 2.0, 1e-3);
  EXPECT_EQ(exact.bodies[0].bias.wide->high, exact.bodies[0].bias.interval->high);
  record.header.plan.bodies[0].volume_sigma_ml = 0.5;
  record.header.plan.bodies[1].volume_sigma_ml = 4.0;
  const VerifyFigures unsure = verify_figures(record);
  EXPECT_EQ(unsure.bodies[0].bias.interval->high, exact.bodies[0].bias.interval->high);
  EXPECT_NEAR(unsure.bodies[0].bias.wide->high, exact.bodies[0].bias.wide->high + 1.0, 1e-9);
  // 1 % and 4 %, two sigma, as if both were wrong to the same side.
  EXPECT_NEAR(unsure.bias.wide->low, exact.bias.wide->low - 2.5, 1e-9);
  EXPECT_EQ(unsure.mape.wide->low, 0.0);
  // An error that the body's own sigma explains is within two.
  EXPECT_NEAR(unsure.bodies[1].within_two.value, 100.0, 1e-9);
}

TEST(VerifyFigures, NothingMeasuredIsNoNumber) {
  VerifyRecord record;
  record.header = sample_header();
  const VerifyFigures none = verify_figures(record);
  EXPECT_FALSE(none.is_complete());
  EXPECT_TRUE(std::isnan(none.bias.value));
  EXPECT_TRUE(std::isnan(none.cv.value));
  EXPECT_FALSE(none.bias.interval);
  EXPECT_FALSE(none.refused.interval);
  EXPECT_EQ(none.worst_body(), nullptr);
}

}  // namespace
}  // namespace traygauge
