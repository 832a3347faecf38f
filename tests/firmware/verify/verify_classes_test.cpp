#include "firmware/verify/verify_classes.hpp"

#include <gtest/gtest.h>

#include "tests/firmware/verify/sample_record.hpp"

namespace traygauge {
namespace {

char best_of(const VerifyRecord& record) {
  const VerifyClass* const best = best_class(verify_figures(record));
  return best == nullptr ? '-' : best->name;
}

TEST(VerifyClasses, GrowLooserFromAToC) {
  for (std::size_t i = 1; i < kVerifyClasses.size(); ++i) {
    const VerifyClass& strict = kVerifyClasses.at(i - 1);
    const VerifyClass& loose = kVerifyClasses.at(i);
    EXPECT_LT(strict.bias, loose.bias);
    EXPECT_LT(strict.body_bias, loose.body_bias);
    EXPECT_LT(strict.mape, loose.mape);
    EXPECT_LT(strict.cv, loose.cv);
    EXPECT_GT(strict.within_two, loose.within_two);
    EXPECT_LT(strict.refused, loose.refused);
    EXPECT_EQ(find_verify_class(std::string(1, loose.name)), &loose);
  }
  EXPECT_EQ(find_verify_class("D"), nullptr);
  EXPECT_EQ(find_verify_class(""), nullptr);
  EXPECT_EQ(find_verify_class("AB"), nullptr);
}

TEST(VerifyClasses, ASmallErrorIsA) {
  EXPECT_EQ(best_of(large_record({0.5, -0.5})), 'A');
}

// A mean of 1.9 % keeps the limit of 2 %, but not the end of its interval.
TEST(VerifyClasses, TheBoundDecidesAndNotTheMean) {
  const VerifyRecord record = large_record({2.9, 0.9});
  EXPECT_NEAR(verify_figures(record).bias.value, 1.9, 1e-9);
  EXPECT_EQ(best_of(record), 'B');
}

TEST(VerifyClasses, EachFigureMatters) {
  const VerifyClass& a = kVerifyClasses.front();
  const auto faults_of = [&](const VerifyRecord& record) {
    std::string all;
    for (const std::string& fault : find_shortcomings(verify_figures(record), a)) all += fault + "\n";
    return all;
  };
  const VerifyRecord good = large_record({0.5, -0.5});
  EXPECT_EQ(faults_of(good), "");

  VerifyRecord refused = good;
  for (int i = 0; i < 3; ++i) refused.scans.push_back(refused_scan("body0-0"));
  EXPECT_NE(faults_of(refused).find("refusals"), std::string::npos) << faults_of(refused);

  VerifyRecord unrepeatable = good;
  for (VerifyScan& scan : unrepeatable.scans) {
    if (scan.step == "repeat-0") scan.volume_ml *= 1.1;
  }
  EXPECT_NE(faults_of(unrepeatable).find("CV"), std::string::npos) << faults_of(unrepeatable);

  VerifyRecord too_sure = good;
  for (VerifyScan& scan : too_sure.scans) scan.sigma_ml *= 0.1;
  EXPECT_NE(faults_of(too_sure).find("two sigma"), std::string::npos) << faults_of(too_sure);

  // One body's error that the others' hides.
  VerifyRecord one_sided = good;
  for (VerifyScan& scan : one_sided.scans) {
    if (scan.step.starts_with("body1")) scan.volume_ml *= 1.045;
    if (scan.step.starts_with("body3")) scan.volume_ml *= 0.955;
    scan.sigma_ml *= 5.0;
  }
  EXPECT_NE(faults_of(one_sided).find("body1"), std::string::npos) << faults_of(one_sided);
  EXPECT_EQ(faults_of(one_sided).find("over all"), std::string::npos) << faults_of(one_sided);

  VerifyRecord unsure = good;
  for (VerifyBody& body : unsure.header.plan.bodies) body.volume_sigma_ml = 0.01 * body.volume_ml;
  EXPECT_NE(faults_of(unsure).find("bias"), std::string::npos) << faults_of(unsure);
}

TEST(VerifyClasses, ATestThatIsTooSmallOrNotFinishedReachesNone) {
  VerifyRecord unfinished = large_record({0.5, -0.5});
  unfinished.scans.pop_back();
  EXPECT_EQ(best_of(unfinished), '-');

  VerifyRecord small;
  small.header = sample_header();
  for (const VerifyStep& step : small.header.plan.steps)
    small.scans.push_back(measured_scan(step.id, small.header.plan.bodies[step.body].volume_ml));
  EXPECT_TRUE(verify_figures(small).is_complete());
  EXPECT_EQ(best_of(small), '-');
}

}  // namespace
}  // namespace traygauge
